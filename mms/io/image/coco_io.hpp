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
  std::int64_t id = 0;    ///< unique in the file
  std::string file_name;  ///< without folder
  int width = 0;          ///< [px]
  int height = 0;         ///< [px]
  std::string split{};    ///< "train", "holdout", ...; empty where the file says nothing
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
  bool iscrowd = false;          ///< neither a hit nor a miss where it is found
  Rle segmentation;              ///< polygons of a file are rasterised as pycocotools does
};

/// COCO's instance annotations.
struct CocoDataset {
  std::vector<CocoImage> images;            ///< in the order of the file
  std::vector<CocoAnnotation> annotations;  ///< in the order of the file
  std::vector<CocoCategory> categories;     ///< in the order of the file
};

/// One object that a network found in one image.
struct CocoResult {
  std::int64_t image_id = 0;  ///< of a `CocoImage`
  int category_id = 0;        ///< of a `CocoCategory`
  double score = 0.0;         ///< confidence in [0, 1]
  Rle segmentation;           ///< of the size of the image
};

/// Annotation of a mask with its box and area.
CocoAnnotation coco_annotation(std::int64_t id, std::int64_t image_id, int category_id,
                               const Rle& mask);

/// Reads instance annotations; segmentations may be polygons and RLE, compressed or not. Keys that
/// are not of `CocoDataset` are passed over.
/// @throws FileError when the file cannot be read; DataError naming the entry, as in
///         "annotations[3].bbox", for missing keys, wrong types, values out of range, ids that are
///         there twice, images and categories that are not there, or masks of another size.
CocoDataset read_coco(const std::filesystem::path& path);

/// Writes what `read_coco` reads back, with compressed RLE. @throws FileError
void write_coco(const std::filesystem::path& path, const CocoDataset& dataset);

/// Reads COCO's results, a list of objects with score and RLE segmentation. Masks carry their own
/// size. @throws FileError, DataError as `read_coco` does.
std::vector<CocoResult> read_coco_results(const std::filesystem::path& path);

/// Writes what `read_coco_results` reads back. @throws FileError
void write_coco_results(const std::filesystem::path& path, const std::vector<CocoResult>& results);

/// Writes the same file result by result, so that they need not be held together. Like an
/// AtomicFile it appears whole or not at all.
class CocoResultsWriter {
 public:
  /// @throws FileError as AtomicFile does.
  explicit CocoResultsWriter(const std::filesystem::path& path);

  /// Appends one result to the list.
  void add(const CocoResult& result);

  /// Ends the list; nothing can be added after it. @throws FileError when anything could not be
  /// written.
  void finish();

 private:
  AtomicFile file_;
  bool empty_ = true;
};

}  // namespace mms
