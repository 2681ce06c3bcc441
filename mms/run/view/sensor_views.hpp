#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/fusion/semantic_fusion.hpp"
#include "mms/pipeline/config.hpp"
#include "mms/run/record/run_record.hpp"
#include "mms/segmentation/segmenters/segmenter.hpp"
#include "mms/server/scene/scene_data.hpp"

namespace mms {

/// Reads the frames of a finished run's recording again and segments and fuses them as the run did,
/// one by one as they are asked for. In order they are what the run saw; after a jump the fusion
/// has forgotten what moved before, so that single points may differ.
class SensorViews {
 public:
  /// @param frames  of the run, with their places in the recording
  /// @throws Error when the recording is not found or cannot be read, or nothing gives its masks.
  SensorViews(RunRecord record, const SystemConfig& config, std::vector<FrameRecord> frames);

  /// Null where the recording has no such frame any more.
  /// @throws Error when the frame or its masks cannot be read.
  std::shared_ptr<const SensorView> load(std::size_t frame);

 private:
  std::optional<Frame> read(const FrameRecord& wanted);
  std::unique_ptr<FrameSource> open() const;

  RunRecord record_;
  SystemConfig config_;
  std::vector<FrameRecord> frames_;
  std::unique_ptr<FrameSource> source_;
  std::unique_ptr<Segmenter> segmenter_;
  std::optional<SemanticFusion> fusion_;
  std::int64_t position_ = 0;        // of the source: the frame it gives next
  std::optional<std::size_t> last_;  // frame of the run that was loaded last
};

}  // namespace mms
