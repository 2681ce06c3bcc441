#include "mms/ros/camera_messages.hpp"

#include <algorithm>

#include "mms/core/error.hpp"

namespace mms {
namespace {

std::array<double, 5> lens_of(const msg::CameraInfo& message, const std::string& where) {
  std::array<double, 5> lens{};
  const auto& D = message.D;
  const bool none = std::all_of(D.begin(), D.end(), [](double d) { return d == 0.0; });
  if (none) return lens;
  const std::string& model = message.distortion_model;
  // RealSense's SDK calls plumb_bob by the names of its authors. "Inverse", as of the D455,
  // projects by the same formula (rs2_project_point_to_pixel), and its ROS driver says plumb_bob.
  const bool known = model == "plumb_bob" || model == "Brown Conrady" ||
                     model == "Inverse Brown Conrady" || model == "rational_polynomial" ||
                     model.empty();
  const bool short_enough = std::all_of(D.begin() + std::ptrdiff_t(std::min(D.size(), lens.size())),
                                        D.end(), [](double d) { return d == 0.0; });
  if (!known || !short_enough) {
    throw DataError(where,
                    "has the distortion model '" + model + "' of " + std::to_string(D.size()) +
                        " coefficients, expected plumb_bob (k1 k2 p1 p2 k3)",
                    "rectify the images, or record a bag and give --calibration");
  }
  std::copy_n(D.begin(), std::min(D.size(), lens.size()), lens.begin());
  return lens;
}

}  // namespace

CameraIntrinsics intrinsics_of(const msg::CameraInfo& message, bool rectified,
                               const std::string& where) {
  CameraIntrinsics camera;
  const bool projection = rectified && message.P[0] > 0.0;
  camera.fx = projection ? message.P[0] : message.K[0];
  camera.fy = projection ? message.P[5] : message.K[4];
  camera.cx = projection ? message.P[2] : message.K[2];
  camera.cy = projection ? message.P[6] : message.K[5];
  camera.width = static_cast<int>(message.width);
  camera.height = static_cast<int>(message.height);
  if (!(camera.fx > 0.0 && camera.fy > 0.0) || camera.width <= 0 || camera.height <= 0) {
    throw DataError(where, "is not calibrated: its focal length is " + std::to_string(camera.fx) +
                               " px, its size " + std::to_string(camera.width) + "x" +
                               std::to_string(camera.height));
  }
  if (message.binning_x > 1 || message.binning_y > 1) {
    throw DataError(where, "has binning " + std::to_string(message.binning_x) + "x" +
                               std::to_string(message.binning_y) + ", which is not supported");
  }
  if (!rectified) camera.distortion = lens_of(message, where);
  return camera;
}

bool is_named_rectified(const std::string& topic) {
  return topic.find("rect") != std::string::npos;
}

msg::CameraInfo camera_info_message(const msg::Header& header, const CameraIntrinsics& camera) {
  msg::CameraInfo message;
  message.header = header;
  message.width = static_cast<std::uint32_t>(camera.width);
  message.height = static_cast<std::uint32_t>(camera.height);
  message.distortion_model = "plumb_bob";
  message.D.assign(camera.distortion.begin(), camera.distortion.end());
  message.K = {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
  message.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  message.P = {camera.fx, 0.0, camera.cx, 0.0, 0.0, camera.fy, camera.cy, 0.0, 0.0, 0.0, 1.0, 0.0};
  return message;
}

}  // namespace mms
