#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mms/evaluation/metrics.hpp"
#include "mms/report/plain_table.hpp"

namespace mms {

/// A run for the paper's tables.
struct PaperRun {
  std::string name;  ///< the paper's for the method
  RunMetrics metrics;
};

/// Table I (instance segmentation) from the trainings of benchmarks/table1.sh: mean over the seeds.
/// @throws FileError, DataError when the folder holds none, or a damaged one
PlainTable segmentation_table(const std::filesystem::path& trainings);

/// Table II (drift of a still sensor), the paper's numbers in both readings of its columns.
/// @param runs  without masks, by vision alone, multi-modal; drift known of all
PlainTable drift_table(const std::string& data, const std::vector<PaperRun>& runs);

/// The localisation comparison: errors against the truth.
PlainTable localization_table(const std::string& data, const std::vector<PaperRun>& runs);

/// Milliseconds a stage.
PlainTable stage_table(const std::vector<PaperRun>& runs);

}  // namespace mms
