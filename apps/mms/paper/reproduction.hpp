#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mms/core/trajectory.hpp"
#include "mms/report/plain_table.hpp"
#include "mms/report/report.hpp"

namespace mms {

/// Where a sensor was said to be, for the localisation figure.
struct NamedPath {
  std::string name;
  Trajectory poses;
};

/// What `mms reproduce` found, for its report.
struct Reproduction {
  std::string title;
  std::vector<PlainTable> tables;
  std::vector<NamedPath> paths;  ///< the truth first, where it is known; all in one frame
  std::vector<ReportPicture> pictures;
};

/// One HTML page that needs nothing else.
std::string reproduction_html(const Reproduction& found);

/// The tables as one JSON object: {"tables": [{"title", "columns", "rows", "note"}]}.
std::string reproduction_json(const Reproduction& found);

}  // namespace mms
