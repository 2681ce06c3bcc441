#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "mms/io/image/coco_io.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/training/data/training_config.hpp"

namespace mms {

/// An annotated object of a file, with class index.
struct Annotated {
  int category = 0;
  bool crowd = false;
  Rle segmentation;
  bool box_only = false;  ///< `segmentation` is its box
};

/// An image of a set before it is read.
struct DataImage {
  std::filesystem::path path;
  std::int64_t id = 0;  ///< in its annotation file
  int width = 0;        ///< as annotated [px]; 0: unknown
  int height = 0;
  std::vector<Annotated> objects{};
  std::vector<int> partial{};  ///< classes whose objects are not all annotated
};

/// Annotation files, each read once: sets often are parts of one file.
class AnnotationFiles {
 public:
  /// What cannot be used is left out.
  /// @throws FileError, DataError if the file cannot be read, or more than half of its images or
  /// annotations have faults.
  const CocoDataset& read(const std::string& path);

  /// What was left out of the files read until now.
  const CocoFaults& faults() const { return faults_; }

 private:
  std::map<std::string, CocoDataset> datasets_;
  CocoFaults faults_;
};

/// The images of a set with their objects of the given classes.
/// @throws FileError, DataError as `AnnotationFiles::read`, or if no image is left.
std::vector<DataImage> list_images(const TrainingData& set, const std::vector<std::string>& classes,
                                   AnnotationFiles& files);

/// The annotation file of a set, or else its folder.
const std::string& name_of(const TrainingData& set);

/// @param bad   messages
/// @param what  "images" or "annotations"
/// @throws DataError with the first message if more than half are bad.
void check_share(const std::string& name, std::span<const std::string> bad, std::size_t total,
                 const std::string& what);

/// @throws DataError if an image differs from its annotated size.
void check_size(const DataImage& image, int width, int height);

}  // namespace mms
