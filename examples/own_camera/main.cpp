// Localizes a depth camera whose driver delivers images through a callback, and prints its poses.
// The driver here simulates a camera that moves 1 cm per image to the right, in an empty room.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <vector>

#include "mms/pipeline/slam_system.hpp"
#include "mms/segmentation/segmenters/mask_segmenter.hpp"

namespace {

constexpr mms::CameraIntrinsics kCamera{200.0, 200.0, 159.5, 119.5, 320, 240};

/// What a driver typically delivers: buffers that it owns.
struct DriverImages {
  const std::uint8_t* rgb;        ///< 3 bytes per pixel, row by row
  const std::uint16_t* depth_mm;  ///< 0: no return
  std::int64_t time_ns;
};

/// Depth along a ray with z = 1, in a room that is 4 m wide, 2.4 m high and 6 m long.
double depth_in_room(const Eigen::Array3d& camera, const Eigen::Array3d& ray) {
  const Eigen::Array3d wall = Eigen::Array3d(2.0, 1.2, 3.0) * ray.sign();
  return ((wall - camera) / ray).minCoeff();
}

void run_driver(int images, const std::function<void(const DriverImages&)>& callback) {
  const int pixels = kCamera.width * kCamera.height;
  const std::vector<std::uint8_t> rgb(3 * pixels, 128);
  std::vector<std::uint16_t> depth(pixels);
  for (int image = 0; image < images; ++image) {
    for (int i = 0; i < pixels; ++i) {
      const double x = (i % kCamera.width - kCamera.cx) / kCamera.fx;
      const double y = (i / kCamera.width - kCamera.cy) / kCamera.fy;
      depth[i] = std::lround(1000.0 * depth_in_room({0.01 * image, 0.0, 0.0}, {x, y, 1.0}));
    }
    callback({rgb.data(), depth.data(), image * 33'000'000LL});
  }
}

/// Copies the images, because the driver reuses its buffers. Depth becomes meters.
mms::Frame make_frame(const DriverImages& images,
                      const std::shared_ptr<const mms::Calibration>& calibration) {
  mms::Frame frame;
  frame.stamp = mms::Timestamp(images.time_ns);
  frame.calibration = calibration;
  frame.color = mms::Image<mms::Rgb>(kCamera.width, kCamera.height);
  frame.depth = mms::Image<float>(kCamera.width, kCamera.height);
  for (std::size_t i = 0; i < frame.color.size(); ++i) {
    frame.color[i] = {images.rgb[3 * i], images.rgb[3 * i + 1], images.rgb[3 * i + 2]};
    frame.depth[i] = 0.001F * images.depth_mm[i];
  }
  return frame;
}

}  // namespace

int main() {
  mms::Calibration calibration;
  calibration.camera = kCamera;
  const auto shared = std::make_shared<const mms::Calibration>(calibration);
  mms::SlamSystem system({}, std::make_unique<mms::MaskSegmenter>());  // no masks: all is static
  // A real driver calls from its own thread. There, only push the frame into mms::BoundedQueue.
  run_driver(10, [&](const DriverImages& images) {
    const mms::OdometryEstimate pose = system.process(make_frame(images, shared)).odometry;
    const Eigen::Vector3d position = pose.T_world_sensor.translation();
    std::printf("%.3f s  %6.3f %6.3f %6.3f m  %s\n", pose.stamp.seconds(), position.x(),
                position.y(), position.z(), to_string(pose.status).data());
  });
}
