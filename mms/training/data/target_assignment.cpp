#include "mms/training/data/target_assignment.hpp"

#include <algorithm>
#include <cmath>

namespace mms {
namespace {

constexpr double kCentreShare = 0.2;  // share of the box's sides: SOLO's sigma
constexpr int kStride = 4;            // of the mask features

struct Centre {
  double x = 0.0;
  double y = 0.0;
};

Centre centre_of_mass(const ObjectMask& object) {
  double sum_x = 0.0;
  double sum_y = 0.0;
  double count = 0.0;
  for (int y = 0; y < object.mask.height(); ++y) {
    for (int x = 0; x < object.mask.width(); ++x) {
      if (object.mask(x, y) == 0) continue;
      sum_x += x;
      sum_y += y;
      count += 1.0;
    }
  }
  return {object.x + sum_x / count, object.y + sum_y / count};
}

/// A quarter-size mask: 1 if at least half of the 4x4 pixels are the object's.
Image<std::uint8_t> quarter_mask(const ObjectMask& object, int width, int height) {
  Image<std::uint8_t> counts(width / kStride, height / kStride);
  for (int y = 0; y < object.mask.height(); ++y) {
    std::uint8_t* row = counts.row((object.y + y) / kStride);
    for (int x = 0; x < object.mask.width(); ++x) {
      row[(object.x + x) / kStride] =
          static_cast<std::uint8_t>(row[(object.x + x) / kStride] + (object.mask(x, y) != 0));
    }
  }
  for (std::uint8_t& count : counts.pixels()) count = count >= kStride * kStride / 2;
  return counts;
}

struct CellSpan {
  int first = 0;
  int last = 0;  ///< inclusive
};

/// Cells of the central part of a box's side, at most one cell from that of the center.
CellSpan central_cells(double centre, double side, int cells, int size) {
  const auto cell = [&](double v) { return static_cast<int>(v / size * cells); };
  const double half = 0.5 * kCentreShare * side;
  const int middle = std::clamp(cell(centre), 0, cells - 1);
  return {std::max({0, cell(centre - half), middle - 1}),
          std::min({cells - 1, cell(centre + half), middle + 1})};
}

/// Marks the cells whose center lies on a crowd.
void ignore_crowd(const ObjectMask& crowd, int grid, int width, int height,
                  std::vector<int>& categories) {
  for (int row = 0; row < grid; ++row) {
    for (int column = 0; column < grid; ++column) {
      const int x = static_cast<int>((column + 0.5) * width / grid) - crowd.x;
      const int y = static_cast<int>((row + 0.5) * height / grid) - crowd.y;
      if (!crowd.mask.contains(x, y) || crowd.mask(x, y) == 0) continue;
      categories[static_cast<std::size_t>(row * grid + column)] = ImageTargets::kIgnored;
    }
  }
}

/// Assigns the cells of one level to an object.
void claim_cells(const ObjectMask& object, const Centre& centre, int grid, const Sample& sample,
                 int level, ImageTargets& targets) {
  const CellSpan columns = central_cells(centre.x, object.mask.width(), grid, sample.image.width());
  const CellSpan rows = central_cells(centre.y, object.mask.height(), grid, sample.image.height());
  auto& categories = targets.categories[static_cast<std::size_t>(level)];
  for (int row = rows.first; row <= rows.last; ++row) {
    for (int column = columns.first; column <= columns.last; ++column) {
      const int cell = row * grid + column;
      std::erase_if(targets.pairs, [&](const ImageTargets::Pair& pair) {
        return pair.level == level && pair.cell == cell;
      });
      categories[static_cast<std::size_t>(cell)] = object.category;
      targets.pairs.push_back({level, cell, static_cast<int>(targets.masks.size()) - 1});
    }
  }
}

}  // namespace

ImageTargets assign_targets(const Sample& sample, const HeadConfig& head) {
  const auto grids = head.grids();
  const auto ranges = head.scale_ranges();
  const int width = sample.image.width();
  const int height = sample.image.height();
  ImageTargets targets;
  targets.partial = sample.partial;
  for (std::size_t level = 0; level < grids.size(); ++level) {
    auto& categories = targets.categories[level];
    categories.assign(static_cast<std::size_t>(grids[level] * grids[level]),
                      ImageTargets::kBackground);
    for (const ObjectMask& object : sample.objects) {
      if (object.crowd) ignore_crowd(object, grids[level], width, height, categories);
    }
  }
  std::vector<const ObjectMask*> ordered;  // smaller objects last
  for (const ObjectMask& object : sample.objects) {
    if (!object.crowd) ordered.push_back(&object);
  }
  std::stable_sort(ordered.begin(), ordered.end(), [](const ObjectMask* a, const ObjectMask* b) {
    return a->mask.size() > b->mask.size();
  });
  for (const ObjectMask* each : ordered) {
    const ObjectMask& object = *each;
    Image<std::uint8_t> mask = quarter_mask(object, width, height);
    if (mask_area(mask) == 0) continue;
    targets.masks.push_back(std::move(mask));
    targets.box_only.push_back(object.box_only);
    const Centre centre = centre_of_mass(object);
    const double size = std::sqrt(object.mask.width() * object.mask.height());
    for (std::size_t level = 0; level < grids.size(); ++level) {
      if (size < ranges[level].min || size > ranges[level].max) continue;
      claim_cells(object, centre, grids[level], sample, static_cast<int>(level), targets);
    }
  }
  return targets;
}

}  // namespace mms
