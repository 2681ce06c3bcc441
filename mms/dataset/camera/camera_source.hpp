#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <memory>
#include <thread>

#include "mms/dataset/camera/camera_calibration.hpp"
#include "mms/dataset/live/live_source.hpp"
#include "mms/dataset/recorder/recording_thread.hpp"

namespace mms {

/// What a run does with a camera.
struct LiveCameraOptions {
  CameraOptions calibration{};
  std::filesystem::path record{};  ///< folder for what comes in; empty: none
  std::size_t frames = std::numeric_limits<std::size_t>::max();  ///< after which it ends
  std::function<bool()> stop{};  ///< whether it should end; called in the camera's thread
};

/// A camera as a source of frames. When it is unplugged there is a warning, and the source ends
/// after the frames that have arrived.
class CameraSource final : public LiveSource {
 public:
  /// @throws DataError as `given_calibration`, `open_camera` and `camera_calibration`; FileError
  /// for the folder.
  CameraSource(const std::string& address, LiveCameraOptions options);
  ~CameraSource() override;

  std::optional<Frame> next() override;
  std::size_t dropped() const override { return LiveSource::dropped() + device_->missed(); }
  std::vector<std::string> describe() const override;

 private:
  void capture();
  /// @returns whether there was one
  bool take_frames(FrameAssembler& assembler);
  void warn_if_idle(FrameAssembler& assembler);

  using Clock = std::chrono::steady_clock;

  std::string address_;
  LiveCameraOptions options_;
  Calibration given_calibration_;
  std::unique_ptr<CameraDevice> device_;
  CameraCalibration calibration_;
  std::unique_ptr<RecordingThread> recorder_;  ///< null for none
  std::size_t given_ = 0;                      ///< of the thread of the run
  std::atomic<bool> ended_ = false;

  // Of the camera's thread:
  std::shared_ptr<const Calibration> shared_;  ///< of the images as they arrive
  std::optional<Timestamp> last_stamp_;
  Clock::time_point last_frame_ = Clock::now();  ///< or warning that there is none

  std::thread thread_;
};

}  // namespace mms
