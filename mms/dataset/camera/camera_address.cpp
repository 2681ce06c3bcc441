#include "mms/dataset/camera/camera_device.hpp"

namespace mms {

bool is_camera_address(std::string_view address) {
  return address.starts_with("camera:");
}

}  // namespace mms
