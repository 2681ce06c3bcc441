#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "mms/io/image/rle.hpp"
#include "mms/io/text/atomic_file.hpp"

namespace mms {

/// One image of a data set.
struct CocoImage {
  std::int64_t id = 0;                 ///< unique in the file
  std::string file_name;               ///< without folder
  int width = 0;                       ///< [px]
  int height = 0;                      ///< [px]
  std::string split{};                 ///< "train", "holdout", ...; empty if absent
  std::vector<std::string> partial{};  ///< categories whose objects are not all annotated
};

/// One class of objects.
struct CocoCategory {
  int id = 0;        ///< unique in the file
  std::string name;  ///< as in "person"
};

/// One object of one image.
struct CocoAnnotation {
  std::int64_t id = 0;           ///< unique in the file
  std::int64_t image_id = 0;     ///< of a `CocoImage`
  int category_id = 0;           ///< of a `CocoCategory`
  std::array<double, 4> bbox{};  ///< x, y, width, height [px]
  double area = 0.0;             ///< [px]
  bool iscrowd = false;          ///< ignored in the evaluation
  bool box_only = false;         ///< the mask is unknown; `segmentation` is the box
  Rle segmentation;              ///< polygons are rasterized as in pycocotools
};

/// COCO instance annotations.
struct CocoDataset {
  std::vector<CocoImage> images;            ///< in the order of the file
  std::vector<CocoAnnotation> annotations;  ///< in the order of the file
  std::vector<CocoCategory> categories;     ///< in the order of the file
};

/// One detection in one image.
struct CocoResult {
  std::int64_t image_id = 0;  ///< of a `CocoImage`
  int category_id = 0;        ///< of a `CocoCategory`
  double score = 0.0;         ///< confidence in [0, 1]
  Rle segmentation;           ///< of the size of the image
};

/// Annotation of a mask with box and area.
CocoAnnotation coco_annotation(std::int64_t id, std::int64_t image_id, int category_id,
                               const Rle& mask);

/// Reads instance annotations; segmentations may be polygons and RLE, compressed or not. Beyond
/// COCO, images may have `split` and `partial`, annotations without a mask `box_only`. Ignores keys
/// that `CocoDataset` does not have.
/// @throws FileError if the file cannot be read; DataError with the entry, as in
/// "annotations[3].bbox", for missing keys, wrong types, values out of range, duplicate ids,
/// unknown images and categories, or masks of a wrong size.
CocoDataset read_coco(const std::filesystem::path& path);

/// Images and annotations that cannot be used: one message each, as of `read_coco`.
struct CocoFaults {
  std::vector<std::string> images{};       ///< what is wrong with an image
  std::vector<std::string> annotations{};  ///< what is wrong with an annotation

  /// Adds the faults of another file.
  void append(const CocoFaults& more) {
    images.insert(images.end(), more.images.begin(), more.images.end());
    annotations.insert(annotations.end(), more.annotations.begin(), more.annotations.end());
  }
};

/// As `read_coco`, but leaves out images and annotations with faults, and boxes that reach outside
/// of the image or have no area. An image that loses an annotation gets all categories as
/// `partial`: what is unannotated there is not background.
/// @param faults  what was left out is appended; annotations of such images are not listed
/// @throws FileError, DataError if the file or one of its three lists cannot be read, or for a
/// category.
CocoDataset read_coco(const std::filesystem::path& path, CocoFaults& faults);

/// Inverse of `read_coco`, with compressed RLE.
/// @throws FileError
void write_coco(const std::filesystem::path& path, const CocoDataset& dataset);

/// Reads COCO results, a list of objects with score and RLE segmentation.
/// @throws FileError, DataError as `read_coco`.
std::vector<CocoResult> read_coco_results(const std::filesystem::path& path);

/// Inverse of `read_coco_results`.
/// @throws FileError
void write_coco_results(const std::filesystem::path& path, const std::vector<CocoResult>& results);

/// Writes results one by one, without holding them in memory. Atomic, like AtomicFile.
class CocoResultsWriter {
 public:
  /// @throws FileError as AtomicFile.
  explicit CocoResultsWriter(const std::filesystem::path& path);

  /// Appends one result to the list.
  void add(const CocoResult& result);

  /// Ends the list; nothing can be added after it.
  /// @throws FileError if a write failed.
  void finish();

 private:
  AtomicFile file_;
  bool empty_ = true;
};

}  // namespace mms
