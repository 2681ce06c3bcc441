#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mms/core/frame.hpp"
#include "mms/core/object_box.hpp"
#include "mms/core/trajectory.hpp"
#include "mms/simulation/truth/truth_cloud.hpp"

namespace mms {

/// A recording that gives its frames one by one. Damaged frames are skipped: `next` goes on to the
/// next good one, reports what was wrong to the warning handler and counts it.
class FrameSource {
 public:
  /// Receives one line naming the file and the fault.
  using WarningHandler = std::function<void(const std::string&)>;

  virtual ~FrameSource() = default;

  /// The next readable frame, or nothing at the end of the recording.
  virtual std::optional<Frame> next() = 0;

  /// Number of frames in the recording, the damaged ones included.
  virtual std::size_t size() const = 0;

  /// Frames skipped so far because they could not be read.
  virtual std::size_t skipped() const = 0;

  /// Passes over the next `count` frames without reading them.
  virtual void skip(std::size_t count) = 0;

  /// Whether any frame comes with a mask.
  virtual bool has_masks() const = 0;

  /// What is known of the sensor before the first frame; null where nothing is.
  virtual std::shared_ptr<const Calibration> calibration() const { return nullptr; }

  /// Truth poses, in the recording's own world frame; empty where there are none.
  virtual const Trajectory& ground_truth() const = 0;

  /// The true map of what the frames given so far show, static and dynamic, in the world frame of
  /// the truth poses; nothing where it is not known. A recording knows only that of all its frames
  /// together, so nothing comes once some were passed over or as long as some are to come.
  /// @throws Error when it is there but cannot be read.
  virtual std::optional<TruthCloud> map_truth() const { return std::nullopt; }

  /// The objects in the frames given so far as they truly are, in the world frame of the truth
  /// poses; empty where that is not known.
  /// @throws Error when it is there but cannot be read.
  virtual ObjectHistory objects_truth() const { return {}; }

  /// What was found, one line a fact, for `mms info`.
  virtual std::vector<std::string> describe() const = 0;

  /// Sets what receives a line for every frame that is skipped; none by default.
  virtual void on_warning(WarningHandler handler) = 0;
};

}  // namespace mms
