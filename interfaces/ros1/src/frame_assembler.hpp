#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "mms/core/frame.hpp"

namespace mms {

/// Puts frames together from images and clouds that arrive one by one: a colour image with the
/// depth image nearest to it in time, or a cloud with the nearest colour image, by the same rules
/// as recordings (within 0.02 s, with clouds 0.05 s). Clouds with images wait for the extrinsics:
/// without them masks would fall on the wrong points. Knows what is missing when no frame comes
/// about.
class FrameAssembler {
 public:
  enum class Sensor { kDepth, kCloud, kCloudWithCamera };

  explicit FrameAssembler(Sensor sensor) : sensor_(sensor) {}

  void set_camera(const CameraIntrinsics& camera);
  void set_extrinsics(const Transform<Camera, Lidar>& T_camera_lidar);
  bool extrinsics_known() const { return extrinsics_known_; }

  /// Images are to come in the order of their stamps; those that do not are left out.
  void add_color(Timestamp stamp, Image<Rgb> color);
  void add_depth(Timestamp stamp, Image<float> depth);
  void add_cloud(Timestamp stamp, LidarScan scan);

  /// The next complete frame, or nothing before more has arrived.
  std::optional<Frame> next();

  /// What arrived since the last call, and what keeps frames from coming about: "depth images: none
  /// arrive". @param seconds  since that call
  std::string report(double seconds);

  /// Colour images or clouds that went without their counterpart.
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
    std::size_t arrived = 0;  ///< since the last report

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
  std::size_t unmatched_ = 0;
  std::size_t made_ = 0;  ///< since the last report
  std::int64_t count_ = 0;
  Duration nearest_miss_{0};
};

}  // namespace mms
