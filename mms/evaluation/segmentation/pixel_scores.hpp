#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mms/io/image/coco_io.hpp"

namespace mms {

/// Heights of objects relative to their image.
enum class HeightClass { kTall, kMedium, kSmall };
inline constexpr std::size_t kHeightClassCount = 3;

/// Agreement of pixels, summed over images.
struct PixelCounts {
  std::int64_t objects = 0;        ///< number of objects
  std::int64_t object_pixels = 0;  ///< of these objects
  std::int64_t covered = 0;        ///< of them, under any mask
  std::int64_t mask_pixels = 0;    ///< of the union of masks, without crowds
  std::int64_t correct = 0;        ///< of them, on any object

  double recall() const;     ///< covered / object_pixels; NaN without any
  double precision() const;  ///< correct / mask_pixels; NaN without any
};

/// How well the pixels of one class are covered, whatever mask covers them: what counts for a map.
struct PixelScores {
  PixelCounts all;
  std::array<PixelCounts, kHeightClassCount> by_height;  ///< of objects, and of masks
};

struct PixelScoreOptions {
  std::string category = "person";
  std::string split{};     ///< only images of this split; empty: all
  double min_score = 0.3;  ///< of the masks: the default of `objects.score`
};

/// Recall and precision of the union of masks. Crowds neither count as objects nor against a mask.
/// Masks must have the size of their images, as `segmentation_error` checks.
PixelScores pixel_scores(const CocoDataset& truth, const std::vector<CocoResult>& results,
                         const PixelScoreOptions& options = {});

/// One row for all objects and one for each class of height, below a header row.
std::string to_table(const PixelScores& scores);

/// One JSON object: `all`, `tall`, `medium` and `small`, each with `objects`, `recall` and
/// `precision`; null if undefined.
std::string to_json(const PixelScores& scores);

}  // namespace mms
