#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mms/io/text/output_folder.hpp"
#include "mms/training/run/trainer.hpp"
#include "mms/training/run/training_log.hpp"
#include "mms/training/run/validation.hpp"

namespace mms {

/// Progress of a training, for the callback.
struct TrainingEvent {
  enum class Kind { kLoading, kLeftOut, kStep, kValidation };
  Kind kind = Kind::kStep;
  int done = 0;                         ///< images read (kLoading) or used
  int total = 0;                        ///< images
  int fresh = 0;                        ///< of `done`, since this start
  std::vector<std::string> left_out{};  ///< kLeftOut: why each image or annotation is not used
  LossPoint loss{};                     ///< kStep: mean since the last event
  std::vector<ApPoint> aps{};           ///< kValidation
};

/// A training in a folder: checkpoint.pt and log.json for continuation, config.yaml,
/// weights.safetensors (the average, after every validation and checkpoint) and report.html.
/// Several processes divide each batch; the first one writes the files, and the result is that of
/// one process but for rounding.
class TrainingRun {
 public:
  /// Continues the training in the folder, if there is one.
  /// @param threads  of the network; 0: one per core
  /// @param place    of this process among those of the training
  /// @param stop     asked while this process waits for the others: true ends that by an Error; a
  /// process without others asks it after each step: true ends the training as the callback does
  /// @throws ConfigError, DataError, FileError for settings without data, a folder with a training
  /// with other settings, or files that cannot be read or written; Error if other processes do not
  /// start or end too early, also in `train`.
  TrainingRun(const TrainingConfig& config, const std::filesystem::path& folder, int threads,
              const ProcessPlace& place = {}, const std::function<bool()>& stop = {});

  /// @param callback  returning false ends the training early, of all processes, after a checkpoint
  void on_event(std::function<bool(const TrainingEvent&)> callback);

  /// Trains to the end of the schedule; false if it ended early.
  bool train();

  /// Whether this process writes the files.
  bool is_first() const { return group_.is_first(); }

  std::filesystem::path weights_path() const { return folder_ / "weights.safetensors"; }
  std::filesystem::path report_path() const { return folder_ / "report.html"; }
  /// Why images and annotations are not used; absent if all are.
  std::filesystem::path left_out_path() const { return folder_ / "left_out.txt"; }

 private:
  void start_or_resume();
  void initialise();
  void share_start();
  void check_same_data(std::size_t images);
  LossPoint mean_of_recent();
  void check_finite();
  bool tell(const TrainingEvent& event);
  bool all_of(bool here);
  bool stopped() const;
  void tell_left_out(const CocoFaults& of_training);
  bool after_step(const torch::Tensor& losses);
  bool log_losses();
  void checkpoint();
  bool validate();
  void write_results();
  int images_seen() const;
  bool every(int images) const;

  TrainingConfig config_;
  std::filesystem::path folder_;
  std::string config_text_;
  ProcessGroup group_;
  Trainer trainer_;
  std::optional<FolderLock> lock_;  ///< of the first process
  TrainingLog log_;
  std::vector<ValidationSet> validation_;
  CocoFaults validation_faults_;
  std::vector<torch::Tensor> recent_;  ///< losses not yet logged
  std::function<bool(const TrainingEvent&)> callback_;
  std::function<bool()> stop_;
  int first_image_ = 0;  ///< images before this start
  std::chrono::steady_clock::time_point clock_;
};

/// The classes of all trainings of this project, in the order of ObjectClass.
std::vector<std::string> training_classes();

}  // namespace mms
