#pragma once

#include <filesystem>
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

/// The images of a set with their objects of the given classes.
/// @param faults  what cannot be used is left out and appended
/// @throws FileError, DataError if the annotations cannot be read, no image is left, or more than
/// half of the images or annotations have faults.
std::vector<DataImage> list_images(const TrainingData& set, const std::vector<std::string>& classes,
                                   CocoFaults& faults);

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
