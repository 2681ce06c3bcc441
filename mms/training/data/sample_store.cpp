#include "mms/training/data/sample_store.hpp"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <map>
#include <mutex>

#include "mms/core/error.hpp"
#include "mms/geometry/parallel.hpp"
#include "mms/segmentation/solo/resize.hpp"
#include "mms/training/data/data_files.hpp"

namespace mms {
namespace {

/// Crops the mask from that of the whole image.
ObjectMask object_of(const Annotated& annotated) {
  const Image<std::uint8_t> mask = decode_rle(annotated.segmentation);
  ObjectMask whole{annotated.category, annotated.crowd, 0, 0, mask, annotated.box_only};
  return tightened(whole);
}

Sample load_sample(const DataImage& source, int largest_side) {
  Sample sample;
  const Image<Rgb> image = read_color(source.path);
  check_size(source, image.width(), image.height());
  const double scale =
      std::min(1.0, static_cast<double>(largest_side) / std::max(image.width(), image.height()));
  sample.width = scaled_length(image.width(), scale);
  sample.height = scaled_length(image.height(), scale);
  sample.image = resize(image, sample.width, sample.height);
  sample.partial = source.partial;
  for (const Annotated& annotated : source.objects) {
    ObjectMask object = placed(object_of(annotated), {.scale = scale,
                                                      .flip = false,
                                                      .source_width = image.width(),
                                                      .dx = 0,
                                                      .dy = 0,
                                                      .width = sample.width,
                                                      .height = sample.height});
    if (!object.mask.empty()) sample.objects.push_back(std::move(object));
  }
  return sample;
}

}  // namespace

SampleStore::SampleStore(const std::vector<TrainingData>& sets,
                         const std::vector<std::string>& classes, int largest_side,
                         const std::function<void(int, int)>& progress) {
  AnnotationFiles files;
  std::vector<std::vector<DataImage>> images;
  std::size_t total = 0;
  for (const TrainingData& set : sets) {
    images.push_back(list_images(set, classes, files));
    total += images.back().size();
  }
  faults_ = files.faults();
  std::mutex mutex;
  int done = 0;
  for (std::size_t k = 0; k < sets.size(); ++k) {
    std::vector<Loaded> loaded(images[k].size());
    parallel_chunks(loaded.size(), 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        try {
          loaded[i].sample = load_sample(images[k][i], largest_side);
        } catch (const Error& error) {
          loaded[i].fault = error.what();
        }
      }
      const std::scoped_lock lock(mutex);
      done += static_cast<int>(end - begin);
      if (progress) progress(done, static_cast<int>(total));
    });
    keep_readable(sets[k], std::move(loaded));
  }
}

void SampleStore::keep_readable(const TrainingData& set, std::vector<Loaded> loaded) {
  const std::size_t before = faults_.images.size();
  for (Loaded& one : loaded) {
    if (!one.fault.empty()) {
      faults_.images.push_back(std::move(one.fault));
      continue;
    }
    samples_.push_back(std::move(one.sample));
    shares_.push_back((shares_.empty() ? 0.0 : shares_.back()) + set.repeat);
  }
  check_share(name_of(set), std::span(faults_.images).subspan(before), loaded.size(), "images");
}

const Sample& SampleStore::draw(RandomStream& random) const {
  const double at = static_cast<double>(random.uniform()) * shares_.back();
  const auto found = std::upper_bound(shares_.begin(), shares_.end(), at);
  const auto index = static_cast<std::size_t>(found - shares_.begin());
  return samples_[std::min(index, samples_.size() - 1)];
}

}  // namespace mms
