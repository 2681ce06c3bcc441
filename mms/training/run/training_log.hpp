#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mms {

/// Mean losses over the steps since the previous point.
struct LossPoint {
  int images = 0;  ///< in training so far
  double loss = 0.0;
  double category_loss = 0.0;
  double mask_loss = 0.0;
  double learning_rate = 0.0;
};

/// Mask AP of the averaged network.
struct ApPoint {
  int images = 0;  ///< in training so far
  std::string set;
  std::string category;
  double ap = 0.0;  ///< in [0, 1]; NaN if the set has no such object
  double ap50 = 0.0;
};

/// Progress of a training.
struct TrainingLog {
  std::vector<LossPoint> losses;
  std::vector<ApPoint> aps;
  double seconds = 0.0;  ///< duration so far, including validation

  /// Removes entries after `images`.
  void rewind(int images);
};

/// Reads log.json.
/// @throws FileError, DataError if it is damaged.
TrainingLog read_training_log(const std::filesystem::path& path);

/// Writes log.json atomically.
/// @throws FileError
void write_training_log(const std::filesystem::path& path, const TrainingLog& log);

/// Writes a page with the curves of losses, APs and learning rate, and the config.
void write_training_report(const std::filesystem::path& path, const std::string& name,
                           const TrainingLog& log, const std::string& config);

}  // namespace mms
