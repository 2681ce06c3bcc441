#include "mms/training/run/validation.hpp"

#include <algorithm>
#include <filesystem>

#include "mms/io/image/image_io.hpp"
#include "mms/training/data/data_files.hpp"

namespace mms {
namespace {

std::string name_of(const TrainingData& set) {
  const std::string folder =
      std::filesystem::path(set.annotations).parent_path().filename().string();
  return set.split.empty() ? folder : folder + " " + set.split;
}

}  // namespace

ValidationSet::ValidationSet(const TrainingData& set, const std::vector<std::string>& classes,
                             int most)
    : name_(name_of(set)) {
  for (std::size_t i = 0; i < classes.size(); ++i) {
    truth_.categories.push_back({static_cast<int>(i) + 1, classes[i]});
  }
  const std::vector<DataImage> all = list_images(set, classes);
  const std::size_t count = std::min(all.size(), static_cast<std::size_t>(most));
  for (std::size_t k = 0; k < count; ++k) {
    const DataImage& image = all[k * all.size() / count];
    images_.push_back(read_color(image.path));
    check_size(image, images_.back().width(), images_.back().height());
    const auto id = static_cast<std::int64_t>(k);
    truth_.images.push_back({.id = id,
                             .file_name = image.path.filename().string(),
                             .width = images_.back().width(),
                             .height = images_.back().height()});
    for (const Annotated& object : image.objects) {
      const auto number = static_cast<std::int64_t>(truth_.annotations.size()) + 1;
      truth_.annotations.push_back(
          coco_annotation(number, id, 1 + object.category, object.segmentation));
      truth_.annotations.back().iscrowd = object.crowd;
    }
  }
}

SegmentationErrors ValidationSet::measure(const DetectFunction& detect) const {
  std::vector<CocoResult> results;
  for (std::size_t i = 0; i < images_.size(); ++i) {
    const CocoImage& image = truth_.images[i];
    for (const Detection& found : detect(images_[i])) {
      results.push_back({image.id, 1 + found.category, found.score,
                         encode_rle(found.mask, found.x, found.y, image.width, image.height)});
    }
  }
  return segmentation_error(truth_, results, {.truth_name = name_});
}

}  // namespace mms
