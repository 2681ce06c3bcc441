#include "mms/dataset/bag/bag_source.hpp"

#include <algorithm>

#include "mms/core/error.hpp"
#include "mms/dataset/bag/bag_recording.hpp"
#include "mms/dataset/source/image_size.hpp"
#include "mms/dataset/source/recorded_source.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/ros/cloud_messages.hpp"
#include "mms/ros/image_messages.hpp"

namespace mms {
namespace {

Image<Rgb> read_color(const BagReader& bag, const BagStream& stream, std::size_t index) {
  const std::string where = bag.where(stream.topic, index);
  if (stream.compressed) {
    return color_of(bag.read<msg::CompressedImage>(stream.topic, index), where);
  }
  return color_of(bag.read<msg::Image>(stream.topic, index), where);
}

Image<float> read_depth(const BagReader& bag, const BagStream& stream, std::size_t index,
                        double scale) {
  const std::string where = bag.where(stream.topic, index);
  if (stream.compressed) {
    return depth_of(bag.read<msg::CompressedImage>(stream.topic, index), where, scale);
  }
  return depth_of(bag.read<msg::Image>(stream.topic, index), where, scale);
}

LidarScan read_cloud(const BagReader& bag, const BagStream& stream, std::size_t index,
                     Timestamp stamp) {
  if (stream.livox) return scan_of(bag.read<msg::LivoxScan>(stream.topic, index));
  return scan_of(bag.read<msg::PointCloud2>(stream.topic, index), stamp,
                 bag.where(stream.topic, index));
}

class BagSource final : public RecordedSource {
 public:
  explicit BagSource(BagRecording recording) : recording_(std::move(recording)) {
    set_ground_truth(std::move(recording_.ground_truth));
    add_motion(std::move(recording_.motion));
    for (const std::string& warning : recording_.warnings) warn(warning);
  }

  std::size_t size() const override { return recording_.frames.size(); }
  bool has_masks() const override {
    return std::any_of(recording_.frames.begin(), recording_.frames.end(), [](const BagFrame& f) {
      return f.mask != BagFrame::kNone || !f.mask_file.empty();
    });
  }
  std::shared_ptr<const Calibration> calibration() const override { return recording_.calibration; }

 protected:
  Timestamp stamp_at(std::size_t index) const override { return recording_.frames[index].stamp; }
  std::string name_at(std::size_t index) const override { return stamp_at(index).to_string(); }
  std::vector<std::string> facts() const override { return recording_.facts; }

  Frame read(std::size_t index) const override {
    const BagFrame& at = recording_.frames[index];
    const BagReader& bag = *recording_.bag;
    Frame frame;
    frame.calibration = recording_.calibration;
    if (at.cloud != BagFrame::kNone) {
      const std::string& topic = recording_.cloud.topic;
      frame.scan = read_cloud(bag, recording_.cloud, at.cloud, at.stamp);
      if (frame.scan.points.empty()) throw DataError(bag.where(topic, at.cloud), "has no points");
    }
    if (at.color != BagFrame::kNone) read_images(frame, at);
    return frame;
  }

 private:
  void read_images(Frame& frame, const BagFrame& at) const {
    constexpr const char* kInfo = "its camera_info says";
    const BagReader& bag = *recording_.bag;
    const CameraIntrinsics& camera = *recording_.calibration->camera;
    frame.color = read_color(bag, recording_.color, at.color);
    check_size(frame.color, camera, bag.where(recording_.color.topic, at.color), kInfo);
    if (at.depth != BagFrame::kNone) {
      const auto& registration = recording_.registration;
      frame.depth =
          read_depth(bag, recording_.depth, at.depth, recording_.calibration->depth_scale);
      check_size(frame.depth, registration ? registration->depth_camera() : camera,
                 bag.where(recording_.depth.topic, at.depth), kInfo,
                 registration ? "" : "it must be registered to the color image");
      if (registration) frame.depth = registration->apply(frame.depth);
      frame.depth_offset = recording_.depth.stamps[at.depth] - at.stamp;
    }
    if (at.mask != BagFrame::kNone) {
      const std::string& topic = recording_.mask.topic;
      frame.mask = mask_of(bag.read<msg::Image>(topic, at.mask), bag.where(topic, at.mask));
      check_size(frame.mask, camera, bag.where(topic, at.mask), kInfo);
    } else if (!at.mask_file.empty()) {
      frame.mask = read_mask(at.mask_file);
      check_size(frame.mask, camera, at.mask_file.string(), kInfo);
    }
  }

  BagRecording recording_;
};

}  // namespace

std::unique_ptr<FrameSource> open_bag(const std::filesystem::path& path,
                                      const SourceOptions& options) {
  return std::make_unique<BagSource>(read_bag_recording(path, options));
}

}  // namespace mms
