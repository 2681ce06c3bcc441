#include "mms/training/data/sample.hpp"

#include <algorithm>
#include <cmath>

namespace mms {
namespace {

struct Span {
  int first = 0;
  int last = -1;  ///< inclusive
};

void widen(Span& span, int value) {
  if (span.last < span.first) span = {value, value};
  span = {std::min(span.first, value), std::max(span.last, value)};
}

/// Pixels of the canvas covered by `length` source pixels from `first`.
Span reach(int first, int length, double scale, int offset, int limit) {
  const int low = static_cast<int>(std::floor(first * scale)) + offset;
  const int high = static_cast<int>(std::ceil((first + length) * scale)) + offset;
  return {std::max(0, low), std::min(limit, high + 1) - 1};
}

}  // namespace

int mask_area(const Image<std::uint8_t>& mask) {
  return static_cast<int>(mask.size()) -
         static_cast<int>(std::count(mask.pixels().begin(), mask.pixels().end(), std::uint8_t{0}));
}

void doubt_box(ObjectMask& rest, double whole) {
  constexpr double kMinPart = 0.5;
  if (rest.box_only && mask_area(rest.mask) < kMinPart * whole) rest.crowd = true;
}

ObjectMask tightened(const ObjectMask& object) {
  Span columns;
  Span rows;
  for (int y = 0; y < object.mask.height(); ++y) {
    for (int x = 0; x < object.mask.width(); ++x) {
      if (object.mask(x, y) == 0) continue;
      widen(columns, x);
      widen(rows, y);
    }
  }
  ObjectMask result = {object.category,       object.crowd, object.x + columns.first,
                       object.y + rows.first, {},           object.box_only};
  if (rows.last < rows.first) return result;
  result.mask = {columns.last - columns.first + 1, rows.last - rows.first + 1};
  for (int y = 0; y < result.mask.height(); ++y) {
    const std::uint8_t* source = object.mask.row(rows.first + y) + columns.first;
    std::copy_n(source, result.mask.width(), result.mask.row(y));
  }
  return result;
}

ObjectMask placed(const ObjectMask& object, const MaskPlacement& p) {
  const int left =
      p.flip ? p.source_width - object.x - object.mask.width() : object.x;  // of the mask
  const Span columns = reach(left, object.mask.width(), p.scale, p.dx, p.width);
  const Span rows = reach(object.y, object.mask.height(), p.scale, p.dy, p.height);
  ObjectMask result = {object.category, object.crowd, columns.first,
                       rows.first,      {},           object.box_only};
  if (columns.last < columns.first || rows.last < rows.first) return result;
  result.mask = {columns.last - columns.first + 1, rows.last - rows.first + 1};
  const auto source = [&](int canvas, int offset) {
    return static_cast<int>(std::floor((canvas - offset + 0.5) / p.scale));
  };
  for (int y = 0; y < result.mask.height(); ++y) {
    const int sy = source(rows.first + y, p.dy) - object.y;
    for (int x = 0; x < result.mask.width(); ++x) {
      const int sx = source(columns.first + x, p.dx) - left;
      if (!object.mask.contains(sx, sy)) continue;
      result.mask(x, y) = object.mask(p.flip ? object.mask.width() - 1 - sx : sx, sy);
    }
  }
  return tightened(result);
}

}  // namespace mms
