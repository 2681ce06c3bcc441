#pragma once

#include <string>
#include <vector>

#include "apps/mms/batch/batch_folder.hpp"
#include "apps/mms/batch/batch_list.hpp"
#include "mms/report/plain_table.hpp"

namespace mms {

/// Tables of the finished runs of a batch, in the order of its list.
struct BatchTables {
  PlainTable accuracy;  ///< equal for equal runs, on any number of machines
  PlainTable speed;
  PlainTable failures;                  ///< without rows if there are none
  std::vector<std::string> unreadable;  ///< finished runs whose results cannot be read
};

BatchTables batch_tables(const BatchFolder& folder, const std::vector<BatchRun>& runs);

/// Writes the tables of all finished runs: batch.csv, times.csv, and report.html.
/// @throws FileError
void write_batch_tables(const BatchFolder& folder, const BatchTables& tables);

}  // namespace mms
