#include "mms/evaluation/segmentation/pixel_scores.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "mms/evaluation/scores/metric_json.hpp"
#include "mms/evaluation/scores/statistics.hpp"

namespace mms {
namespace {

/// [-]: heights relative to the image from which on an object is tall, and medium. A person of
/// 1.7 m is a third of the image of a Kinect at 6 m, an eighth at 15 m.
constexpr double kTall = 1.0 / 3.0;
constexpr double kMedium = 1.0 / 8.0;

constexpr std::array<const char*, kHeightClassCount> kKeys = {"tall", "medium", "small"};
constexpr std::array<const char*, kHeightClassCount> kHeightNames = {"above 1/3", "1/8 to 1/3",
                                                                     "below 1/8"};

std::size_t height_class(const Rle& mask) {
  const double height = rle_box(mask)[3] / mask.height;
  const HeightClass found = height > kTall     ? HeightClass::kTall
                            : height > kMedium ? HeightClass::kMedium
                                               : HeightClass::kSmall;
  return static_cast<std::size_t>(found);
}

using Pixels = Image<std::uint8_t>;

void unite(const Pixels& more, Pixels& all) {
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = all[i] | more[i];
}

/// Number of pixels in both.
std::int64_t common(const Pixels& a, const Pixels& b) {
  std::int64_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += (a[i] & b[i]) != 0;
  return count;
}

/// Pixels of `a` outside of `b`.
Pixels without(const Pixels& a, const Pixels& b) {
  Pixels rest = a;
  for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = a[i] != 0 && b[i] == 0 ? 1 : 0;
  return rest;
}

/// Objects and masks of one class in one image.
struct InImage {
  std::vector<const Rle*> objects;
  std::vector<const Rle*> crowds;
  std::vector<const Rle*> masks;
};

Pixels union_of(const std::vector<const Rle*>& masks, int width, int height) {
  Pixels all(width, height);
  for (const Rle* mask : masks) unite(decode_rle(*mask), all);
  return all;
}

void add_objects(const std::vector<const Rle*>& objects, const Pixels& found, PixelCounts& counts) {
  for (const Rle* object : objects) {
    ++counts.objects;
    counts.object_pixels += static_cast<std::int64_t>(rle_area(*object));
    counts.covered += common(decode_rle(*object), found);
  }
}

void add_masks(const Pixels& found, const Pixels& truth, const Pixels& crowd, PixelCounts& counts) {
  const Pixels counted = without(found, without(crowd, truth));
  counts.mask_pixels += common(counted, counted);
  counts.correct += common(counted, truth);
}

std::vector<const Rle*> of_height(const std::vector<const Rle*>& masks, std::size_t height) {
  std::vector<const Rle*> some;
  std::copy_if(masks.begin(), masks.end(), std::back_inserter(some),
               [&](const Rle* mask) { return height_class(*mask) == height; });
  return some;
}

void add(const InImage& image, int width, int height, PixelScores& scores) {
  const Pixels truth = union_of(image.objects, width, height);
  const Pixels crowd = union_of(image.crowds, width, height);
  const Pixels found = union_of(image.masks, width, height);
  add_objects(image.objects, found, scores.all);
  add_masks(found, truth, crowd, scores.all);
  for (std::size_t k = 0; k < kHeightClassCount; ++k) {
    add_objects(of_height(image.objects, k), found, scores.by_height[k]);
    add_masks(union_of(of_height(image.masks, k), width, height), truth, crowd,
              scores.by_height[k]);
  }
}

nlohmann::ordered_json json_of(const PixelCounts& counts) {
  const std::vector<MetricValue> values = {
      {"objects", "objects", static_cast<double>(counts.objects), "", 0},
      {"recall", "recall of pixels", counts.recall(), "", 3},
      {"precision", "precision of pixels", counts.precision(), "", 3}};
  return json_object(values);
}

/// The text in a table column of `width` characters, aligned to its right.
std::string column(const std::string& text, std::size_t width) {
  return std::string(width - std::min(width, text.size()), ' ') + text;
}

std::string row(std::string name, const std::string& objects, const std::string& recall,
                const std::string& precision) {
  name.resize(10, ' ');
  return name + column(objects, 8) + column(recall, 8) + column(precision, 11) + "\n";
}

std::string row(const std::string& name, const PixelCounts& counts) {
  return row(name, std::to_string(counts.objects), to_fixed(counts.recall(), 3),
             to_fixed(counts.precision(), 3));
}

}  // namespace

double PixelCounts::recall() const {
  return ratio(covered, object_pixels);
}

double PixelCounts::precision() const {
  return ratio(correct, mask_pixels);
}

PixelScores pixel_scores(const CocoDataset& truth, const std::vector<CocoResult>& results,
                         const PixelScoreOptions& options) {
  const auto category =
      std::find_if(truth.categories.begin(), truth.categories.end(),
                   [&](const CocoCategory& one) { return one.name == options.category; });
  if (category == truth.categories.end()) return {};
  std::map<std::int64_t, InImage> images;
  for (const CocoAnnotation& annotation : truth.annotations) {
    if (annotation.category_id != category->id) continue;
    InImage& image = images[annotation.image_id];
    (annotation.iscrowd ? image.crowds : image.objects).push_back(&annotation.segmentation);
  }
  for (const CocoResult& result : results) {
    if (result.category_id != category->id || result.score < options.min_score) continue;
    images[result.image_id].masks.push_back(&result.segmentation);
  }
  PixelScores scores;
  for (const CocoImage& image : truth.images) {
    if (!options.split.empty() && image.split != options.split) continue;
    const auto found = images.find(image.id);
    if (found != images.end()) add(found->second, image.width, image.height, scores);
  }
  return scores;
}

std::string to_table(const PixelScores& scores) {
  std::string table = row("height", "objects", "recall", "precision");
  for (std::size_t k = 0; k < kHeightClassCount; ++k) {
    table += row(kHeightNames[k], scores.by_height[k]);
  }
  return table + row("all", scores.all);
}

std::string to_json(const PixelScores& scores) {
  nlohmann::ordered_json json = {{"all", json_of(scores.all)}};
  for (std::size_t k = 0; k < kHeightClassCount; ++k) json[kKeys[k]] = json_of(scores.by_height[k]);
  return json.dump();
}

}  // namespace mms
