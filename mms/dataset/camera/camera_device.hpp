#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mms/core/calibration.hpp"
#include "mms/dataset/live/frame_assembler.hpp"

namespace mms {

/// Begin of the addresses of cameras: "camera:openni2", "camera:openni2:URI".
bool is_camera_address(std::string_view address);

/// A camera that is plugged in.
struct CameraInfo {
  std::string name;
  std::string vendor;
  std::string uri;
  std::vector<std::string> modes;  ///< "color 640x480, 30 Hz, RGB888"
  std::string fault;               ///< why it cannot be opened; empty: it can
};

/// All cameras that OpenNI2 finds.
/// @throws DataError if OpenNI2 cannot start, or the program was built without it.
std::vector<CameraInfo> list_cameras();

/// Color and registered depth images of a camera, or of a recording of one.
class CameraDevice {
 public:
  enum class Event {
    kImage,    ///< one was added
    kNothing,  ///< none came in time
    kEnd       ///< the camera was unplugged, or the recording is at its end
  };

  virtual ~CameraDevice() = default;

  /// Waits for the next image and adds it to `frames`: colors with the stamps of the camera's
  /// clock, and depth [m].
  /// @throws DataError if it cannot be read.
  virtual Event read(FrameAssembler& frames, std::chrono::milliseconds timeout) = 0;

  /// Vendor and name.
  virtual std::string name() const = 0;

  /// Of the color images, from their field of view: centered, without distortion.
  virtual CameraIntrinsics intrinsics() const = 0;

  /// Depth units per meter.
  virtual double depth_scale() const = 0;

  /// Color images of the recording; 0 for a camera.
  virtual std::size_t size() const = 0;

  /// Color images that were lost so far, by their numbers.
  virtual std::size_t missed() const = 0;
};

/// Opens a camera: 640x480 pixels, depth registered to color.
/// @param address  "camera:openni2" (the first one), "camera:openni2:INDEX" or "camera:openni2:URI"
/// @throws DataError in one sentence: no such camera, in use, no color or depth images, no such
/// mode, or the program was built without OpenNI2.
std::unique_ptr<CameraDevice> open_camera(const std::string& address);

/// Opens a recording of OpenNI2, x.oni, which is read image by image.
/// @throws DataError as `open_camera`.
std::unique_ptr<CameraDevice> open_oni(const std::filesystem::path& path);

}  // namespace mms
