#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "mms/dataset/source/recorded_source.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

/// Files of one colour image with depth.
struct RgbdFiles {
  Timestamp stamp;              ///< of the colour image
  Duration depth_offset{0};     ///< of the depth image, relative to `stamp`
  std::filesystem::path color;  ///< 8-bit image
  std::filesystem::path depth;  ///< 16-bit image, registered to `color`
  std::filesystem::path mask;   ///< empty where there is none
  std::string name;             ///< what the mask of the frame is called, without ".png"
};

/// All that a folder layout says about an RGB-D recording; the images are not read yet.
struct RgbdRecording {
  std::filesystem::path folder;                    ///< of the recording
  std::vector<RgbdFiles> frames;                   ///< in the order of their stamps
  std::shared_ptr<const Calibration> calibration;  ///< with a camera
  std::uint16_t invalid_depth = 0;                 ///< raw value that means no return besides 0
  Trajectory ground_truth;                         ///< empty where there is none
  std::vector<std::string> facts;                  ///< lines for `describe`
  std::vector<std::string> warnings;               ///< what was wrong but can be lived with
};

/// Finds the frames' masks, in `options.masks` or else the recording's own masks/; says in facts
/// and warnings how many there are.
/// @throws DataError when `options.masks` is given and has a mask for none of the frames.
void find_masks(RgbdRecording& recording, const SourceOptions& options);

/// Reads the images of an RGB-D recording. Images of another size than the calibration's are
/// damaged frames.
class RgbdSource final : public RecordedSource {
 public:
  /// Reads no image yet.
  explicit RgbdSource(RgbdRecording recording);

  std::size_t size() const override { return recording_.frames.size(); }
  bool has_masks() const override;
  std::shared_ptr<const Calibration> calibration() const override { return recording_.calibration; }

 protected:
  Timestamp stamp_at(std::size_t index) const override { return recording_.frames[index].stamp; }
  std::string name_at(std::size_t index) const override { return recording_.frames[index].name; }
  Frame read(std::size_t index) const override;
  std::vector<std::string> facts() const override;

 private:
  RgbdRecording recording_;
};

}  // namespace mms
