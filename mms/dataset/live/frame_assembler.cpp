#include "mms/dataset/live/frame_assembler.hpp"

#include <algorithm>
#include <chrono>

#include "mms/dataset/source/image_size.hpp"

namespace mms {
namespace {

constexpr Duration kImageReach = std::chrono::milliseconds(20);
constexpr Duration kScanReach = std::chrono::milliseconds(50);
constexpr Duration kSameTime = std::chrono::milliseconds(5);  // closer than any later image can be
constexpr std::size_t kMaxUnmatched = 30;                     // largest number per kind

Duration time_between(Timestamp a, Timestamp b) {
  return a < b ? b - a : a - b;
}

template <class T>
void check_live_size(const Image<T>& image, const CameraIntrinsics& camera, const char* what) {
  check_size(image, camera, what, "the camera_info says",
             "depth must be registered to the color image");
}

std::string rate_text(const char* what, std::size_t arrived, double seconds) {
  if (arrived == 0) return std::string(what) + ": none received";
  char rate[32];
  std::snprintf(rate, sizeof rate, "%.1f", static_cast<double>(arrived) / seconds);
  return std::string(what) + ": " + rate + " per second";
}

}  // namespace

template <class T>
void FrameAssembler::Stream<T>::add(Timestamp stamp, T data) {
  ++arrived;
  if (latest && stamp + kMaxStepBack < *latest) {
    waiting.clear();
    latest.reset();
  }
  latest = latest ? std::max(*latest, stamp) : stamp;
  if (!waiting.empty() && stamp <= waiting.back().stamp) return;
  waiting.push_back({stamp, std::move(data)});
  if (waiting.size() > kMaxUnmatched) waiting.pop_front();
}

void FrameAssembler::set_camera(const CameraIntrinsics& camera) {
  if (calibration_.camera && *calibration_.camera == camera) return;
  calibration_.camera = camera;
  shared_.reset();
}

void FrameAssembler::set_depth_camera(const DepthCamera& camera) {
  calibration_.depth_camera = camera;
  shared_.reset();
}

void FrameAssembler::set_extrinsics(const Transform<Camera, Lidar>& T_camera_lidar) {
  calibration_.T_camera_lidar = T_camera_lidar;
  extrinsics_known_ = true;
  shared_.reset();
}

void FrameAssembler::add_color(Timestamp stamp, Image<Rgb> color) {
  color_.add(stamp, std::move(color));
}
void FrameAssembler::add_depth(Timestamp stamp, Image<float> depth) {
  depth_.add(stamp, std::move(depth));
}
void FrameAssembler::add_cloud(Timestamp stamp, LidarScan scan) {
  cloud_.add(stamp, std::move(scan));
}

/// Whether the partner nearest to `stamp` has arrived and none that arrives later can be nearer.
template <class T>
bool FrameAssembler::is_decided(Timestamp stamp, const Stream<T>& partners, Duration reach) const {
  for (const auto& partner : partners.waiting) {
    if (time_between(partner.stamp, stamp) <= kSameTime || partner.stamp > stamp + reach)
      return true;
    if (partner.stamp >= stamp) return true;
  }
  return false;
}

template <class T>
std::optional<FrameAssembler::Stamped<T>> FrameAssembler::take_nearest(Timestamp stamp,
                                                                       Stream<T>& partners,
                                                                       Duration reach) {
  auto& waiting = partners.waiting;
  const auto nearest = std::min_element(waiting.begin(), waiting.end(), [&](auto& a, auto& b) {
    return time_between(a.stamp, stamp) < time_between(b.stamp, stamp);
  });
  if (nearest == waiting.end()) return std::nullopt;
  if (time_between(nearest->stamp, stamp) > reach) {
    nearest_miss_ = time_between(nearest->stamp, stamp);
    return std::nullopt;
  }
  std::optional<Stamped<T>> taken = std::move(*nearest);
  waiting.erase(waiting.begin(), nearest + 1);
  return taken;
}

Frame FrameAssembler::frame_at(Timestamp stamp) {
  if (!shared_) shared_ = std::make_shared<const Calibration>(calibration_);
  Frame frame;
  frame.index = count_++;
  frame.stamp = stamp;
  frame.name = stamp.to_string();
  frame.calibration = shared_;
  ++made_;
  return frame;
}

std::optional<Frame> FrameAssembler::next_depth_frame() {
  while (calibration_.camera && !color_.waiting.empty()) {
    const Timestamp stamp = color_.waiting.front().stamp;
    if (!is_decided(stamp, depth_, kImageReach)) return std::nullopt;
    auto depth = take_nearest(stamp, depth_, kImageReach);
    Image<Rgb> color = std::move(color_.waiting.front().data);
    color_.waiting.pop_front();
    if (!depth) {
      ++unmatched_;
      continue;
    }
    check_live_size(color, *calibration_.camera, "color image");
    check_live_size(
        depth->data,
        calibration_.depth_camera ? calibration_.depth_camera->camera : *calibration_.camera,
        "depth image");
    Frame frame = frame_at(stamp);
    frame.color = std::move(color);
    color_stamp_ = stamp;
    frame.depth = std::move(depth->data);
    frame.depth_offset = depth->stamp - stamp;
    return frame;
  }
  return std::nullopt;
}

std::optional<Frame> FrameAssembler::next_cloud_frame() {
  const bool camera = sensor_ == Sensor::kCloudWithCamera;
  const bool calibrated = calibration_.camera && extrinsics_known_;
  if (cloud_.waiting.empty() || (camera && !calibrated)) return std::nullopt;
  const Timestamp stamp = cloud_.waiting.front().stamp;
  const bool waits = camera && cloud_.waiting.size() < 3 && !is_decided(stamp, color_, kScanReach);
  if (waits) return std::nullopt;
  Frame frame = frame_at(stamp);
  frame.scan = std::move(cloud_.waiting.front().data);
  cloud_.waiting.pop_front();
  color_stamp_.reset();
  if (!camera) return frame;
  if (auto color = take_nearest(stamp, color_, kScanReach)) {
    check_live_size(color->data, *calibration_.camera, "color image");
    frame.color = std::move(color->data);
    color_stamp_ = color->stamp;
  } else {
    ++unmatched_;
  }
  return frame;
}

std::optional<Frame> FrameAssembler::next() {
  return sensor_ == Sensor::kDepth ? next_depth_frame() : next_cloud_frame();
}

std::string FrameAssembler::report(double seconds) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  const bool both_arrive = color_.arrived > 0 && depth_.arrived > 0;
  if (sensor_ != Sensor::kCloud) {
    add(rate_text("color images", color_.arrived, seconds));
    if (!calibration_.camera) add("camera_info: none received");
  }
  if (sensor_ == Sensor::kDepth) {
    add(rate_text("depth images", depth_.arrived, seconds));
    if (made_ == 0 && both_arrive && calibration_.camera) {
      char apart[64];
      std::snprintf(apart, sizeof apart, "no two within 0.02 s, the last ones are %.3f s apart",
                    to_seconds(nearest_miss_));
      add(apart);
    }
  } else {
    add(rate_text("clouds", cloud_.arrived, seconds));
    const bool both = cloud_.arrived > 0 && color_.arrived > 0;
    if (sensor_ == Sensor::kCloudWithCamera && both && !extrinsics_known_) {
      add("no transform from the cloud's frame to the camera's");
    }
  }
  color_.arrived = depth_.arrived = cloud_.arrived = made_ = 0;
  return text;
}

}  // namespace mms
