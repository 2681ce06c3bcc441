#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mms/core/trajectory.hpp"
#include "mms/report/plain_table.hpp"
#include "mms/report/report.hpp"
#include "mms/report/view_axes.hpp"

namespace mms {

/// A trajectory with its name, for the localization figure.
struct NamedPath {
  std::string name;
  Trajectory poses;
};

/// Results of `mms reproduce` for its report.
struct Reproduction {
  std::string title;
  std::vector<PlainTable> tables;
  std::vector<NamedPath> paths;    ///< ground truth first, if known; all in one frame
  UpAxis up = UpAxis::kNegativeY;  ///< of the frame of `paths`
  std::vector<ReportPicture> pictures;
};

/// One self-contained HTML page.
std::string reproduction_html(const Reproduction& found);

/// The tables as one JSON object: {"tables": [{"title", "columns", "rows", "note"}]}.
std::string reproduction_json(const Reproduction& found);

}  // namespace mms
