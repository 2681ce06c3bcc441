#include "mms/core/error.hpp"
#include "mms/dataset/camera/openni2_device.hpp"

// Replaces openni2_device.cpp if OpenNI2 is missing.

namespace mms {
namespace {

[[noreturn]] void fail_without_openni2(const std::string& what) {
  throw DataError(what, "needs OpenNI2, but mms was built without it",
                  "install libopenni2-dev, run cmake again and build");
}

}  // namespace

std::vector<CameraInfo> list_openni2_cameras() {
  fail_without_openni2(std::string(kOpenNi2Address));
}

std::unique_ptr<CameraDevice> open_openni2_camera(const std::string& address, const std::string&) {
  fail_without_openni2(address);
}

std::unique_ptr<CameraDevice> open_oni(const std::filesystem::path& path) {
  fail_without_openni2(path.string());
}

}  // namespace mms
