#include "mms/training/data/data_files.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/core/size_text.hpp"
#include "mms/io/image/picture_files.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;

std::vector<DataImage> folder_images(const fs::path& folder) {
  std::vector<DataImage> images;
  for (const fs::path& path : list_pictures(folder)) images.push_back({.path = path});
  return images;
}

/// Index in `classes` of each category of the file that is one of them.
std::map<int, int> category_indices(const CocoDataset& dataset,
                                    const std::vector<std::string>& classes) {
  std::map<int, int> indices;
  for (const CocoCategory& category : dataset.categories) {
    const auto found = std::find(classes.begin(), classes.end(), category.name);
    if (found != classes.end()) {
      indices[category.id] = static_cast<int>(found - classes.begin());
    }
  }
  return indices;
}

std::vector<DataImage> annotated_images(const TrainingData& set,
                                        const std::vector<std::string>& classes,
                                        AnnotationFiles& files) {
  const CocoDataset& dataset = files.read(set.annotations);
  const fs::path folder =
      set.images.empty() ? fs::path(set.annotations).parent_path() : fs::path(set.images);
  std::vector<DataImage> images;
  std::map<std::int64_t, std::size_t> places;
  for (const CocoImage& image : dataset.images) {
    if (!set.split.empty() && image.split != set.split) continue;
    places[image.id] = images.size();
    images.push_back({.path = picture_path(folder, image.file_name),
                      .id = image.id,
                      .width = image.width,
                      .height = image.height});
    for (const std::string& name : image.partial) {
      const auto found = std::find(classes.begin(), classes.end(), name);
      if (found == classes.end()) continue;
      images.back().partial.push_back(static_cast<int>(found - classes.begin()));
    }
  }
  const std::map<int, int> indices = category_indices(dataset, classes);
  for (const CocoAnnotation& annotation : dataset.annotations) {
    const auto place = places.find(annotation.image_id);
    const auto index = indices.find(annotation.category_id);
    if (place == places.end() || index == indices.end()) continue;
    images[place->second].objects.push_back(
        {index->second, annotation.iscrowd, annotation.segmentation, annotation.box_only});
  }
  return images;
}

void keep_containing(const std::string& name, const std::vector<std::string>& classes,
                     std::vector<DataImage>& images) {
  const auto found = std::find(classes.begin(), classes.end(), name);
  if (found == classes.end()) {
    throw ConfigError("data.containing", "'" + name + "' is none of the network's classes",
                      "use one of its classes");
  }
  const int category = static_cast<int>(found - classes.begin());
  const auto lacks = [&](const DataImage& image) {
    return std::none_of(image.objects.begin(), image.objects.end(),
                        [&](const Annotated& object) { return object.category == category; });
  };
  images.erase(std::remove_if(images.begin(), images.end(), lacks), images.end());
}

}  // namespace

const CocoDataset& AnnotationFiles::read(const std::string& path) {
  const auto known = datasets_.find(path);
  if (known != datasets_.end()) return known->second;
  CocoFaults found;
  CocoDataset dataset = read_coco(path, found);
  faults_.append(found);
  check_share(path, found.images, found.images.size() + dataset.images.size(), "images");
  check_share(path, found.annotations, found.annotations.size() + dataset.annotations.size(),
              "annotations");
  return datasets_.emplace(path, std::move(dataset)).first->second;
}

const std::string& name_of(const TrainingData& set) {
  return set.annotations.empty() ? set.images : set.annotations;
}

void check_share(const std::string& name, std::span<const std::string> bad, std::size_t total,
                 const std::string& what) {
  if (2 * bad.size() <= total) return;
  throw DataError(name,
                  std::to_string(bad.size()) + " of " + std::to_string(total) + " " + what +
                      " cannot be used, allowed: at most half; first: " + bad.front(),
                  "correct them, or remove the set");
}

std::vector<DataImage> list_images(const TrainingData& set, const std::vector<std::string>& classes,
                                   AnnotationFiles& files) {
  if (set.annotations.empty() && set.images.empty()) {
    throw ConfigError("data", "has a set with neither annotations nor images",
                      "set at least one of them");
  }
  std::vector<DataImage> images =
      set.annotations.empty() ? folder_images(set.images) : annotated_images(set, classes, files);
  if (!set.containing.empty()) keep_containing(set.containing, classes, images);
  if (set.limit > 0) images.resize(std::min(images.size(), static_cast<std::size_t>(set.limit)));
  if (images.empty()) {
    std::string what = "has no images";
    if (!set.split.empty()) what += " in the split '" + set.split + "'";
    if (!set.containing.empty()) what += " with the class '" + set.containing + "'";
    throw DataError(name_of(set), what);
  }
  return images;
}

void check_size(const DataImage& image, int width, int height) {
  if (image.width == 0 || (image.width == width && image.height == height)) return;
  throw DataError(image.path.string(), "is " + size_text(width, height) + ", annotated as " +
                                           size_text(image.width, image.height));
}

}  // namespace mms
