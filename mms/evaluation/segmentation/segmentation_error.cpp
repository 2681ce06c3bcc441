#include "mms/evaluation/segmentation/segmentation_error.hpp"

#include <cmath>
#include <map>
#include <set>

#include "mms/core/error.hpp"
#include "mms/evaluation/segmentation/class_scores.hpp"

namespace mms {
namespace {

std::string joined(const std::set<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text.empty() ? "none" : text;
}

std::string pixels_text(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " px";
}

/// Checks that results match their images.
class ResultCheck {
 public:
  ResultCheck(const CocoDataset& truth, const SegmentationErrorOptions& options)
      : options_(options) {
    for (const CocoImage& image : truth.images) images_[image.id] = &image;
  }

  /// @param index  of the result in its list
  void operator()(const CocoResult& result, std::size_t index) const {
    const auto found = images_.find(result.image_id);
    if (found == images_.end()) {
      fail(index, "image_id", "is " + std::to_string(result.image_id) + ", no such image",
           "the images are those of " + options_.truth_name);
    }
    if (!std::isfinite(result.score)) fail(index, "score", "is not a number", "expected 0 to 1");
    const CocoImage& image = *found->second;
    const Rle& mask = result.segmentation;
    if (mask.width == image.width && mask.height == image.height) return;
    fail(index, "segmentation",
         "has " + pixels_text(mask.width, mask.height) + ", its image " + std::to_string(image.id) +
             " has " + pixels_text(image.width, image.height),
         "masks must have the size of the image in " + options_.truth_name);
  }

 private:
  [[noreturn]] void fail(std::size_t index, const std::string& key, const std::string& what,
                         const std::string& hint) const {
    throw DataError(options_.results_name + ": [" + std::to_string(index) + "]." + key, what, hint);
  }

  const SegmentationErrorOptions& options_;
  std::map<std::int64_t, const CocoImage*> images_;
};

/// Groups ground truth and results by class and image, filtered by the options.
class SortedByClass {
 public:
  SortedByClass(const CocoDataset& truth, const SegmentationErrorOptions& options) {
    take_categories(truth, options);
    take_images(truth, options);
    for (const CocoAnnotation& annotation : truth.annotations) {
      ClassInImage* place = find(annotation.category_id, annotation.image_id);
      if (place == nullptr) continue;
      place->truth.push_back(&annotation);
      ++counted_.objects;
    }
  }

  void take(const CocoResult& result) {
    ClassInImage* place = find(result.category_id, result.image_id);
    if (place == nullptr) return;
    place->results.push_back(&result);
    ++counted_.results;
  }

  SegmentationErrors errors() const {
    SegmentationErrors errors = counted_;
    for (const auto& [id, one] : classes_) {
      errors.per_class.push_back({one.name, class_scores(one.images)});
    }
    errors.all = mean_scores(errors.per_class);
    return errors;
  }

 private:
  struct OneClass {
    std::string name;
    ClassInImages images{};
  };

  void take_categories(const CocoDataset& truth, const SegmentationErrorOptions& options) {
    std::set<std::string> names;
    for (const CocoCategory& category : truth.categories) {
      names.insert(category.name);
      if (!options.category.empty() && category.name != options.category) continue;
      classes_[category.id] = {category.name};
    }
    if (options.category.empty() || !classes_.empty()) return;
    throw DataError(options.truth_name, "has no class '" + options.category + "'",
                    "its classes: " + joined(names));
  }

  void take_images(const CocoDataset& truth, const SegmentationErrorOptions& options) {
    std::set<std::string> splits;
    for (const CocoImage& image : truth.images) {
      if (!image.split.empty()) splits.insert(image.split);
      if (options.split.empty() || image.split == options.split) images_.insert(image.id);
    }
    counted_.images = images_.size();
    if (options.split.empty() || !images_.empty()) return;
    throw DataError(options.truth_name, "has no images in the split '" + options.split + "'",
                    "its splits: " + joined(splits));
  }

  /// Entry of a class and image; null if one of them is not evaluated.
  ClassInImage* find(int category, std::int64_t image) {
    const auto found = classes_.find(category);
    if (found == classes_.end() || !images_.contains(image)) return nullptr;
    return &found->second.images[image];
  }

  std::map<int, OneClass> classes_;  ///< by id
  std::set<std::int64_t> images_;
  SegmentationErrors counted_;  ///< without scores yet
};

}  // namespace

SegmentationErrors segmentation_error(const CocoDataset& truth,
                                      const std::vector<CocoResult>& results,
                                      const SegmentationErrorOptions& options) {
  SortedByClass sorted(truth, options);
  const ResultCheck check(truth, options);
  for (std::size_t i = 0; i < results.size(); ++i) {
    check(results[i], i);
    sorted.take(results[i]);
  }
  return sorted.errors();
}

}  // namespace mms
