#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mms/core/calibration.hpp"
#include "mms/dataset/live/frame_assembler.hpp"

namespace mms {

inline constexpr int kCameraWidth = 640;   ///< of images, without a calibration [px]
inline constexpr int kCameraHeight = 480;  ///< [px]

/// Begin of the addresses of cameras: "camera:openni2", "camera:v4l2:0".
bool is_camera_address(std::string_view address);

/// A camera that is plugged in.
struct CameraInfo {
  std::string address;  ///< "camera:openni2:0"
  std::string name;
  std::string vendor;
  std::string uri;                 ///< of OpenNI2, or the USB bus and the files of V4L2
  std::vector<std::string> modes;  ///< "color 640x480, 30 Hz, RGB888"
  std::string fault;               ///< why it cannot be used; empty: it can
};

/// All cameras that were found.
struct CameraList {
  std::vector<CameraInfo> cameras;
  std::vector<std::string> faults;  ///< what could not be searched, each with its cause
};

/// Cameras of OpenNI2 and V4L2.
CameraList list_cameras();

/// Color and depth images of a camera, or of a recording of one.
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

  /// Of the color images, from their field of view: centered, without distortion; nullopt if the
  /// camera does not tell it.
  virtual std::optional<CameraIntrinsics> intrinsics() const = 0;

  /// Whether depth images are registered to the color images.
  virtual bool registers_depth() const = 0;

  /// Depth units per meter; nullopt if the camera does not tell them.
  virtual std::optional<double> depth_scale() const = 0;

  /// Color images of the recording; 0 for a camera.
  virtual std::size_t size() const = 0;

  /// Color images that were lost so far, by their numbers.
  virtual std::size_t missed() const = 0;
};

/// Opens a camera.
/// @param address  "camera:openni2" or "camera:v4l2" (the first one), or these with ":INDEX" or
/// ":URI"
/// @param given  calibration by the user. V4L2 needs its sizes and depth scale; OpenNI2 ignores it:
/// its images have 640x480 pixels, depth registered to color.
/// @throws DataError in one sentence: no such camera, in use, no color or depth images, no such
/// mode, no calibration, or the program was built without OpenNI2.
std::unique_ptr<CameraDevice> open_camera(const std::string& address, const Calibration& given);

}  // namespace mms
