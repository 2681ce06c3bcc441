#include "mms/dataset/camera/camera_calibration.hpp"

#include <cstdio>
#include <memory>

#include "mms/core/error.hpp"
#include "mms/core/size_text.hpp"
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
  return size_text(camera.width, camera.height);
}

}  // namespace

Calibration given_calibration(const CameraOptions& options) {
  Calibration calibration;
  if (!options.file.empty()) {
    calibration = read_any_calibration(options.file).calibration;
    if (!calibration.camera && !options.intrinsics) {
      throw DataError(options.file.string(), "has no camera", "add fx fy cx cy width height");
    }
  }
  if (options.intrinsics) {
    const auto& k = *options.intrinsics;
    const CameraIntrinsics size = calibration.camera.value_or(
        CameraIntrinsics{.width = kCameraWidth, .height = kCameraHeight});
    calibration.camera = {k[0], k[1], k[2], k[3], size.width, size.height, {}};
  }
  if (options.depth_scale) calibration.depth_scale = *options.depth_scale;
  return calibration;
}

CameraCalibration camera_calibration(const CameraDevice& device, const std::string& what,
                                     const CameraOptions& options, const Calibration& given) {
  if (options.depth_scale && device.depth_scale()) {
    throw DataError("--depth-scale", "is for recordings and V4L2", "this camera says its own");
  }
  CameraCalibration result{given, "its field of view"};
  Calibration& calibration = result.calibration;
  if (!options.file.empty()) result.origin = options.file.filename().string();
  if (options.intrinsics) result.origin = "--intrinsics";
  if (device.registers_depth()) calibration.depth_camera.reset();
  const std::optional<CameraIntrinsics> of_device = device.intrinsics();
  if (!calibration.camera) calibration.camera = of_device;
  const CameraIntrinsics& camera = calibration.camera.value();
  if (of_device && side_text(camera) != side_text(*of_device)) {
    throw DataError(options.file.string(), "is for images of " + side_text(camera) +
                                               " pixels, those of " + what + " have " +
                                               side_text(*of_device));
  }
  check_camera(camera, what + ": camera");
  if (const auto scale = device.depth_scale()) calibration.depth_scale = *scale;
  result.origin = "intrinsics from " + result.origin + " (" + intrinsics_text(camera) + ")";
  return result;
}

}  // namespace mms
