#include "mms/dataset/camera/camera_calibration.hpp"

#include <cstdio>
#include <memory>

#include "mms/core/error.hpp"
#include "mms/geometry/depth_registration.hpp"
#include "mms/io/config/calibration_formats.hpp"

namespace mms {
namespace {

std::string intrinsics_text(const CameraIntrinsics& camera) {
  char text[96];
  std::snprintf(text, sizeof text, "fx %.1f, fy %.1f, cx %.1f, cy %.1f", camera.fx, camera.fy,
                camera.cx, camera.cy);
  return text;
}

std::string side_text(const CameraIntrinsics& camera) {
  return std::to_string(camera.width) + "x" + std::to_string(camera.height);
}

}  // namespace

CameraCalibration camera_calibration(const CameraDevice& device, const std::string& what,
                                     const CameraOptions& options) {
  if (options.depth_scale) {
    throw DataError("--depth-scale", "is for recordings", "the camera says its own");
  }
  const CameraIntrinsics of_device = device.intrinsics();
  CameraCalibration result;
  Calibration& calibration = result.calibration;
  std::string origin = "its field of view";
  if (!options.file.empty()) {
    calibration = read_any_calibration(options.file).calibration;
    // The device registers its depth images.
    calibration = *registered_calibration(std::make_shared<const Calibration>(calibration));
    origin = options.file.filename().string();
  }
  if (options.intrinsics) {
    const auto& k = *options.intrinsics;
    calibration.camera = {k[0], k[1], k[2], k[3], of_device.width, of_device.height, {}};
    origin = "--intrinsics";
  }
  if (!calibration.camera) {
    if (!options.file.empty()) {
      throw DataError(options.file.string(), "has no camera", "add fx fy cx cy width height");
    }
    calibration.camera = of_device;
  }
  const CameraIntrinsics& camera = *calibration.camera;
  if (camera.width != of_device.width || camera.height != of_device.height) {
    throw DataError(options.file.string(), "is for images of " + side_text(camera) +
                                               " pixels, those of " + what + " have " +
                                               side_text(of_device));
  }
  check_camera(camera, what + ": camera");
  calibration.depth_scale = device.depth_scale();
  result.origin = "intrinsics from " + origin + " (" + intrinsics_text(camera) + ")";
  return result;
}

}  // namespace mms
