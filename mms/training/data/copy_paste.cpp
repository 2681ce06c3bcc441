#include <algorithm>
#include <cstdlib>
#include <numeric>

#include "mms/training/data/augmentation.hpp"

namespace mms {
namespace {

// The paper's 10 px and 300 px at 1024 px, scaled to the size of our networks' inputs.
constexpr int kMovedSide = 3;
constexpr int kSmallRest = 30;

/// Random subset; all subsets of equal size are equally likely.
std::vector<std::size_t> random_choice(std::size_t count, RandomStream& random) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  order.resize(random.below(count + 1));
  return order;
}

void paste_pixels(Sample& target, const Sample& source, const ObjectMask& object) {
  for (int y = 0; y < object.mask.height(); ++y) {
    for (int x = 0; x < object.mask.width(); ++x) {
      if (object.mask(x, y) == 0) continue;
      target.image(object.x + x, object.y + y) = source.image(object.x + x, object.y + y);
    }
  }
}

/// Removes the area of `cover` from a mask.
void cut(ObjectMask& object, const ObjectMask& cover) {
  for (int y = 0; y < object.mask.height(); ++y) {
    for (int x = 0; x < object.mask.width(); ++x) {
      const int cx = object.x + x - cover.x;
      const int cy = object.y + y - cover.y;
      if (cover.mask.contains(cx, cy) && cover.mask(cx, cy) != 0) object.mask(x, y) = 0;
    }
  }
}

bool hardly_left(const ObjectMask& before, const ObjectMask& after) {
  const bool moved =
      std::abs(before.x - after.x) > kMovedSide || std::abs(before.y - after.y) > kMovedSide ||
      std::abs(before.x + before.mask.width() - after.x - after.mask.width()) > kMovedSide ||
      std::abs(before.y + before.mask.height() - after.y - after.mask.height()) > kMovedSide;
  const int area = mask_area(after.mask);
  return area < kMinObjectPixels || (moved && area <= kSmallRest);
}

}  // namespace

void paste_objects(Sample& target, const Sample& source, RandomStream& random) {
  std::vector<ObjectMask> pasted;
  for (const std::size_t i : random_choice(source.objects.size(), random)) {
    const ObjectMask& object = source.objects[i];
    if (object.crowd || object.box_only) continue;
    paste_pixels(target, source, object);
    pasted.push_back(object);
  }
  std::vector<ObjectMask> kept;
  for (const ObjectMask& object : target.objects) {
    ObjectMask rest = object;
    for (const ObjectMask& cover : pasted) cut(rest, cover);
    rest = tightened(rest);
    doubt_box(rest, mask_area(object.mask));
    if (!hardly_left(object, rest)) kept.push_back(std::move(rest));
  }
  kept.insert(kept.end(), pasted.begin(), pasted.end());
  target.objects = std::move(kept);
  for (const ObjectMask& object : pasted) {
    target.width = std::max(target.width, object.x + object.mask.width());
    target.height = std::max(target.height, object.y + object.mask.height());
  }
}

}  // namespace mms
