#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/fusion/semantic_fusion.hpp"
#include "mms/pipeline/system_config.hpp"
#include "mms/run/record/run_record.hpp"
#include "mms/segmentation/segmenters/segmenter.hpp"
#include "mms/server/scene/scene_data.hpp"

namespace mms {

/// Reads frames of a finished run's recording again, segments and fuses them as in the run, one by
/// one on request. In sequence the results are those of the run; after a jump single points may
/// differ, because the fusion lacks its history.
class SensorViews {
 public:
  /// @param frames  of the run, with their indices in the recording
  /// @throws Error if the recording is missing or unreadable, or there is no source of masks.
  SensorViews(RunRecord record, const SystemConfig& config, std::vector<FrameRecord> frames);

  /// Null if the recording no longer has the frame.
  /// @throws Error if the frame or its masks cannot be read.
  std::shared_ptr<const SensorView> load(std::size_t frame);

 private:
  std::optional<Frame> read(const FrameRecord& requested);
  std::unique_ptr<FrameSource> open() const;

  RunRecord record_;
  SystemConfig config_;
  std::vector<FrameRecord> frames_;
  std::unique_ptr<FrameSource> source_;
  std::unique_ptr<Segmenter> segmenter_;
  std::optional<SemanticFusion> fusion_;
  std::int64_t position_ = 0;        // index of the source's next frame
  std::optional<std::size_t> last_;  // last loaded frame of the run
};

}  // namespace mms
