#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "mms/core/frame.hpp"

namespace mms {

/// Assembles frames from images and clouds that arrive one by one: a color image with the depth
/// image nearest in time, or a cloud with the nearest color image, by the same rules as for
/// recordings (within 0.02 s, with clouds 0.05 s). Clouds with images wait for the extrinsics,
/// without which masks would be misplaced. Reports what is missing.
class FrameAssembler {
 public:
  /// [s]: step back of the stamps that is one of the clock. Source: initial choice; far above the
  /// delay of messages that come out of order.
  static constexpr Duration kMaxStepBack = std::chrono::seconds(1);

  enum class Sensor { kDepth, kCloud, kCloudWithCamera };

  explicit FrameAssembler(Sensor sensor) : sensor_(sensor) {}

  void set_camera(const CameraIntrinsics& camera);
  /// Of depth images that are not registered. The frames have it in their calibration, until
  /// `LiveSource` registers them.
  void set_depth_camera(const DepthCamera& camera);
  void set_extrinsics(const Transform<Camera, Lidar>& T_camera_lidar);
  bool extrinsics_known() const { return extrinsics_known_; }

  /// Images must arrive in order of stamps; others are dropped. Where the clock of the stamps goes
  /// back by more than 1 s, as of recordings that are played again, those that wait are dropped.
  void add_color(Timestamp stamp, Image<Rgb> color);
  void add_depth(Timestamp stamp, Image<float> depth);
  void add_cloud(Timestamp stamp, LidarScan scan);

  /// The next complete frame; nullopt if none is complete.
  std::optional<Frame> next();

  /// Stamp of the color image of the last frame that `next` gave; nullopt if it has none. Frames of
  /// clouds have the stamps of their clouds.
  std::optional<Timestamp> color_stamp() const { return color_stamp_; }

  /// Statistics since the last call, and what is missing for frames: "depth images: none received".
  /// @param seconds  since the last call
  std::string report(double seconds);

  /// Number of color images or clouds without counterpart.
  std::size_t unmatched() const { return unmatched_; }

 private:
  template <class T>
  struct Stamped {
    Timestamp stamp;
    T data;
  };
  template <class T>
  struct Stream {
    std::deque<Stamped<T>> waiting;
    std::size_t arrived = 0;            ///< since the last report
    std::optional<Timestamp> latest{};  ///< since its clock went back

    void add(Timestamp stamp, T data);
  };

  template <class T>
  bool is_decided(Timestamp stamp, const Stream<T>& partners, Duration reach) const;
  template <class T>
  std::optional<Stamped<T>> take_nearest(Timestamp stamp, Stream<T>& partners, Duration reach);
  std::optional<Frame> next_depth_frame();
  std::optional<Frame> next_cloud_frame();
  Frame frame_at(Timestamp stamp);

  Sensor sensor_;
  Calibration calibration_;
  bool extrinsics_known_ = false;
  std::shared_ptr<const Calibration> shared_;
  Stream<Image<Rgb>> color_;
  Stream<Image<float>> depth_;
  Stream<LidarScan> cloud_;
  std::optional<Timestamp> color_stamp_;
  std::size_t unmatched_ = 0;
  std::size_t made_ = 0;  ///< since the last report
  std::int64_t count_ = 0;
  Duration nearest_miss_{0};
};

}  // namespace mms
