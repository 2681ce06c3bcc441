#include "mms/training/run/validation.hpp"

#include <algorithm>
#include <filesystem>

#include "mms/core/error.hpp"
#include "mms/io/image/image_io.hpp"

namespace mms {
namespace {

std::string display_name(const TrainingData& set) {
  const std::string folder =
      std::filesystem::path(set.annotations).parent_path().filename().string();
  return set.split.empty() ? folder : folder + " " + set.split;
}

}  // namespace

ValidationSet::ValidationSet(const TrainingData& set, const std::vector<std::string>& classes,
                             int most, CocoFaults& faults)
    : name_(display_name(set)) {
  for (std::size_t i = 0; i < classes.size(); ++i) {
    truth_.categories.push_back({static_cast<int>(i) + 1, classes[i]});
  }
  AnnotationFiles files;
  const std::vector<DataImage> all = list_images(set, classes, files);
  faults.append(files.faults());
  const std::size_t count = std::min(all.size(), static_cast<std::size_t>(most));
  const std::size_t before = faults.images.size();
  for (std::size_t k = 0; k < count; ++k) {
    try {
      add(all[k * all.size() / count]);
    } catch (const Error& error) {
      faults.images.emplace_back(error.what());
    }
  }
  check_share(name_of(set), std::span(faults.images).subspan(before), count, "images");
}

void ValidationSet::add(const DataImage& source) {
  Image<Rgb> image = read_color(source.path);
  check_size(source, image.width(), image.height());
  const auto id = static_cast<std::int64_t>(images_.size());
  truth_.images.push_back({.id = id,
                           .file_name = source.path.filename().string(),
                           .width = image.width(),
                           .height = image.height()});
  images_.push_back(std::move(image));
  for (const Annotated& object : source.objects) {
    const auto number = static_cast<std::int64_t>(truth_.annotations.size()) + 1;
    truth_.annotations.push_back(
        coco_annotation(number, id, 1 + object.category, object.segmentation));
    // A box is no mask: what is found in it counts neither as right nor as wrong.
    truth_.annotations.back().iscrowd = object.crowd || object.box_only;
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
