#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mms/evaluation/metrics.hpp"
#include "mms/report/plain_table.hpp"

namespace mms {

/// A run for the paper's tables.
struct PaperRun {
  std::string name;  ///< name of the method in the paper
  RunMetrics metrics;
};

/// Table I (instance segmentation) from the trainings of benchmarks/table1.sh: mean over the seeds.
/// @throws FileError, DataError if the folder has none, or a damaged one
PlainTable segmentation_table(const std::filesystem::path& trainings);

/// Table II (drift of a static sensor), with both readings of the paper's columns.
/// @param runs  without masks, vision only, multimodal; all with drift
PlainTable drift_table(const std::string& data, const std::vector<PaperRun>& runs);

/// Localization errors against ground truth.
PlainTable localization_table(const std::string& data, const std::vector<PaperRun>& runs);

/// Milliseconds per stage.
PlainTable stage_table(const std::vector<PaperRun>& runs);

}  // namespace mms
