#include "mms/dataset/camera/camera_device.hpp"

#include "mms/core/error.hpp"
#include "mms/dataset/camera/openni2_device.hpp"
#include "mms/dataset/camera/v4l2_device.hpp"

namespace mms {
namespace {

/// Part of an address after a kind of camera: "" for the kind alone, nullopt for another kind.
std::optional<std::string> part_after(std::string_view kind, std::string_view address) {
  if (!address.starts_with(kind)) return std::nullopt;
  address.remove_prefix(kind.size());
  if (address.empty()) return "";
  if (address.front() != ':') return std::nullopt;
  return std::string(address.substr(1));
}

}  // namespace

bool is_camera_address(std::string_view address) {
  return address.starts_with("camera:");
}

CameraList list_cameras() {
  CameraList list;
  for (const auto& search : {list_openni2_cameras, list_v4l2_cameras}) {
    try {
      for (CameraInfo& camera : search()) list.cameras.push_back(std::move(camera));
    } catch (const DataError& error) {
      list.faults.emplace_back(error.what());
    }
  }
  return list;
}

std::unique_ptr<CameraDevice> open_camera(const std::string& address, const Calibration& given) {
  if (const auto which = part_after(kOpenNi2Address, address)) {
    return open_openni2_camera(address, *which);
  }
  if (const auto which = part_after(kV4l2Address, address)) {
    return open_v4l2_camera(address, *which, given);
  }
  throw DataError(address, "is no camera that is known",
                  "camera:openni2 or camera:v4l2, with :INDEX or :URI if there are several; mms "
                  "cameras lists those that are plugged in");
}

}  // namespace mms
