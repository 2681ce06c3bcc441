#pragma once

#include <filesystem>

#include "mms/dataset/source/assumed_stamp.hpp"
#include "mms/dataset/source/frame_source.hpp"

namespace mms {

/// Common part of recordings on disk: frames in order of time; damaged frames and frames whose
/// stamp does not increase are skipped with a warning.
class RecordedSource : public FrameSource {
 public:
  std::optional<Frame> next() final;
  std::size_t skipped() const final { return skipped_; }
  void skip(std::size_t count) final;
  bool has_masks() const override { return false; }
  const Trajectory& ground_truth() const final { return ground_truth_; }
  std::optional<TruthCloud> map_truth() const final;
  ObjectHistory objects_truth() const final;
  void add_motion(MotionRecording motion) final;
  bool set_rate(double rate) final;
  std::vector<std::string> describe() const final;

  /// The handler also receives earlier warnings.
  void on_warning(WarningHandler handler) final;

 protected:
  /// Stamp of a frame, available without reading it.
  virtual Timestamp stamp_at(std::size_t index) const = 0;
  /// Name of a frame for messages, available without reading it.
  virtual std::string name_at(std::size_t index) const = 0;

  /// The frame without index, stamp and name, which `next` sets.
  /// @throws Error if it cannot be read.
  virtual Frame read(std::size_t index) const = 0;

  /// Facts that precede the common ones in `describe`.
  virtual std::vector<std::string> facts() const = 0;

  /// Passes a line to the warning handler, or stores it until there is one.
  void warn(const std::string& message);
  /// Sets the poses that `ground_truth` returns.
  void set_ground_truth(Trajectory trajectory) { ground_truth_ = std::move(trajectory); }

  /// Tells that the recording has no time stamps, and those of its frames and poses assume a rate.
  void set_assumed_rate(std::optional<AssumedRate> rate) { assumed_rate_ = rate; }

  /// Sets the file of the ground-truth map of all frames, which may be missing. It is read on
  /// request.
  void set_map_truth(std::filesystem::path file) { map_truth_ = std::move(file); }
  /// Sets the file of the ground-truth objects of all frames, which may be missing.
  void set_objects_truth(std::filesystem::path file) { objects_truth_ = std::move(file); }

 private:
  /// Of a frame, at the rate that is given.
  Timestamp stamp_of(std::size_t index) const;
  std::string rate_fact() const;
  /// That the rate is a guess; empty if it is not.
  std::string rate_fault() const;
  /// That the frames are too far apart for their stamps to be in a known unit; empty if not.
  std::string step_fault() const;
  /// That the ground truth is of another time than the recording; empty if it is not.
  std::string clock_fault() const;
  std::optional<Frame> try_read(std::size_t index);

  std::size_t position_ = 0;
  std::size_t skipped_ = 0;
  bool passed_over_ = false;  ///< frames were skipped by `skip`
  std::optional<Timestamp> last_stamp_;
  Trajectory ground_truth_;
  std::optional<AssumedRate> assumed_rate_;  ///< nullopt: stamps are those of the recording
  std::optional<double> given_rate_;         ///< [Hz] in place of it
  MotionFeed motion_;
  std::vector<std::string> motion_facts_;
  std::filesystem::path map_truth_;
  std::filesystem::path objects_truth_;
  WarningHandler handler_;
  std::vector<std::string> pending_warnings_;
  bool has_told_faults_ = false;  ///< of the whole recording
};

}  // namespace mms
