#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mms/dataset/source/recorded_source.hpp"
#include "mms/dataset/source/source_options.hpp"
#include "mms/geometry/depth_registration.hpp"
#include "mms/io/video/video_reader.hpp"

namespace mms {

/// Files of a color image with depth.
struct RgbdFiles {
  Timestamp stamp;              ///< of the color image
  Duration depth_offset{0};     ///< of the depth image, relative to `stamp`
  std::filesystem::path color;  ///< 8-bit image, or the video
  std::filesystem::path depth;  ///< as of `read_depth`
  std::filesystem::path mask;   ///< empty for none
  std::string name;             ///< file name of the frame's mask without ".png"
  std::size_t video_index = 0;  ///< of the color image, if `color` is a video
};

/// An RGB-D recording before its images are read.
struct RgbdRecording {
  std::filesystem::path folder;   ///< of the recording
  std::vector<RgbdFiles> frames;  ///< in order of stamps
  /// With a camera; its `depth_camera` is that of the depth images, if they are not registered.
  std::shared_ptr<const Calibration> calibration;
  /// Camera of the color images and masks where it is not that of the depth images. It has the
  /// same place and orientation; colors and masks are sampled for the pixels of the depth images.
  std::optional<CameraIntrinsics> color_camera;
  std::shared_ptr<VideoReader> video;       ///< of the color images; null: each is a file
  std::uint16_t invalid_depth = 0;          ///< raw value for no return besides 0
  double float_depth_scale = 1.0;           ///< units per meter of floating-point depth images
  std::optional<AssumedRate> assumed_rate;  ///< of the stamps; nullopt: they are the recording's
  Trajectory ground_truth;                  ///< empty for none
  std::vector<std::string> facts;           ///< lines for `describe`
  std::vector<std::string> warnings;        ///< non-fatal faults
};

/// Finds the frames' masks in `options.masks`, or else in the recording's masks/; adds their number
/// to facts and warnings.
/// @throws DataError if `options.masks` is given and has no mask for any frame.
void find_masks(RgbdRecording& recording, const SourceOptions& options);

/// The color image of a frame.
/// @throws FileError, DataError if it cannot be read.
Image<Rgb> read_color_of(const RgbdRecording& recording, const RgbdFiles& frame);

/// Reads the images of an RGB-D recording. Images of a size other than the calibration's are
/// damaged frames.
class RgbdSource final : public RecordedSource {
 public:
  /// Does not read images.
  explicit RgbdSource(RgbdRecording recording);

  std::size_t size() const override { return recording_.frames.size(); }
  bool has_masks() const override;
  std::shared_ptr<const Calibration> calibration() const override { return calibration_; }

 protected:
  Timestamp stamp_at(std::size_t index) const override { return recording_.frames[index].stamp; }
  std::string name_at(std::size_t index) const override { return recording_.frames[index].name; }
  Frame read(std::size_t index) const override;
  std::vector<std::string> facts() const override;

 private:
  RgbdRecording recording_;
  std::shared_ptr<const Calibration> calibration_;  ///< of the frames
  std::optional<DepthRegistration> registration_;   ///< of depth images that need it
};

}  // namespace mms
