#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "mms/evaluation/segmentation/segmentation_scores.hpp"
#include "mms/io/image/coco_io.hpp"

namespace mms::test {

/// A mask of w x h px with its corner at (x, y), in an image of `size` x `size` px.
inline Rle box(int x, int y, int w, int h, int size = 100) {
  Image<std::uint8_t> mask(size, size);
  for (int v = y; v < y + h; ++v) {
    for (int u = x; u < x + w; ++u) mask(u, v) = 1;
  }
  return encode_rle(mask);
}

/// Images 1 to `images` of `size` x `size` px, with the class 1 "person", without objects.
inline CocoDataset empty_truth(int images, int size = 100) {
  CocoDataset truth;
  for (int id = 1; id <= images; ++id) truth.images.push_back({id, "", size, size});
  truth.categories = {{1, "person"}};
  return truth;
}

/// Adds a person to an image, with the mask's area.
inline CocoAnnotation& add_person(CocoDataset& truth, std::int64_t image, const Rle& mask) {
  const auto id = static_cast<std::int64_t>(truth.annotations.size()) + 1;
  return truth.annotations.emplace_back(coco_annotation(id, image, 1, mask));
}

constexpr double kTolerance = 1e-9;  // of the numbers of pycocotools

/// Expects the first of the twelve numbers, including NaN.
inline void expect_scores(const SegmentationScores& found, const std::vector<double>& expected) {
  const std::vector<MetricValue> values = metric_values(found);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (std::isnan(expected[i])) {
      EXPECT_TRUE(std::isnan(values[i].value)) << values[i].key;
    } else {
      EXPECT_NEAR(values[i].value, expected[i], kTolerance) << values[i].key;
    }
  }
}

}  // namespace mms::test
