#include "mms/run/view/sensor_views.hpp"

#include <utility>

#include "mms/dataset/open_dataset.hpp"
#include "mms/run/segmenter/segmenter_choice.hpp"

namespace mms {

SensorViews::SensorViews(RunRecord record, const SystemConfig& config,
                         std::vector<FrameRecord> frames)
    : record_(std::move(record)),
      config_(config),
      frames_(std::move(frames)),
      source_(open()),
      segmenter_(make_segmenter(record_.segmenter, record_.data, config_, *source_)) {}

std::unique_ptr<FrameSource> SensorViews::open() const {
  return open_dataset(record_.data, {.masks = record_.masks,
                                     .load_masks = record_.segmenter == "masks",
                                     .map_truth = false,
                                     .topics = record_.topics,
                                     .camera = record_.given,
                                     .rate = record_.rate});
}

/// The frame with that index and stamp. Recordings are read forward only.
std::optional<Frame> SensorViews::read(const FrameRecord& requested) {
  if (requested.index < position_) {
    source_ = open();
    position_ = 0;
  }
  source_->skip(static_cast<std::size_t>(requested.index - position_));
  position_ = requested.index + 1;
  std::optional<Frame> frame = source_->next();
  if (!frame || frame->stamp != requested.stamp) {
    source_ = open();  // its position is unknown after damaged frames
    position_ = 0;
    return std::nullopt;
  }
  return frame;
}

std::shared_ptr<const SensorView> SensorViews::load(std::size_t index) {
  if (index >= frames_.size()) return nullptr;
  std::optional<Frame> frame = read(frames_[index]);
  if (!frame) return nullptr;
  if (!fusion_ || !last_ || index != *last_ + 1)
    fusion_.emplace(with_noise(config_.fusion, config_.noise));
  last_ = index;
  LabeledCloud cloud = fusion_->fuse(*frame, segmenter_->segment(*frame));
  return std::make_shared<const SensorView>(
      SensorView{index, std::move(frame->color), std::move(cloud)});
}

}  // namespace mms
