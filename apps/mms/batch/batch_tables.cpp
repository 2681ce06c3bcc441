#include "apps/mms/batch/batch_tables.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "apps/mms/paper/reproduction.hpp"
#include "mms/core/error.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/files.hpp"

namespace mms {
namespace {

/// A column: its name, where its value is in metrics.json, and the digits after the point.
struct Column {
  const char* name;
  const char* place;
  int digits;
};

constexpr Column kAccuracy[] = {{"frames", "/frames", 0},
                                {"lost", "/status/lost", 0},
                                {"ate_rmse_m", "/trajectory/ate_rmse_m", 4},
                                {"ate_corrected_m", "/loops/trajectory/ate_rmse_m", 4},
                                {"loops", "/loops/closed", 0},
                                {"map_aa_pct", "/map/aa_pct", 1},
                                {"idf1_pct", "/objects/idf1_pct", 1}};
constexpr Column kSpeed[] = {{"rate_hz", "/rate_hz", 1},
                             {"mean_s", "/time_per_frame_s/mean", 4},
                             {"p99_s", "/time_per_frame_s/p99", 4},
                             {"peak_memory_mb", "/peak_memory_mb", 0}};

using Json = nlohmann::json;

Json metrics_of(const BatchFolder& folder, const std::string& name) {
  const std::filesystem::path file = folder.results(name) / "metrics.json";
  Json metrics = Json::parse(read_file(file), nullptr, false);
  if (metrics.is_discarded())
    throw DataError(file.string(), "is not JSON", "remove the run's folder, and it is done again");
  return metrics;
}

/// NaN where there is none.
double value_at(const Json& metrics, const char* place) {
  const Json::json_pointer pointer(place);
  if (!metrics.contains(pointer) || !metrics.at(pointer).is_number()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return metrics.at(pointer).get<double>();
}

std::string cell(double value, int digits) {
  return std::isnan(value) ? "" : fmt::format("{:.{}f}", value, digits);
}

/// A table of the values of all runs, with their median and maximum if there are several.
template <std::size_t n>
PlainTable table_of(const std::string& title, const Column (&columns)[n],
                    const std::vector<std::pair<std::string, Json>>& runs) {
  PlainTable table;
  table.title = title;
  table.columns = {"run"};
  std::vector<std::vector<double>> values(n);
  for (const Column& column : columns) table.columns.emplace_back(column.name);
  for (const auto& [name, metrics] : runs) {
    std::vector<std::string> row = {name};
    for (std::size_t c = 0; c < n; ++c) {
      const double value = value_at(metrics, columns[c].place);
      if (!std::isnan(value)) values[c].push_back(value);
      row.push_back(cell(value, columns[c].digits));
    }
    table.rows.push_back(std::move(row));
  }
  if (runs.size() < 2) return table;
  std::vector<std::string> median = {"median"};
  std::vector<std::string> maximum = {"maximum"};
  for (std::size_t c = 0; c < n; ++c) {
    std::sort(values[c].begin(), values[c].end());
    const std::size_t count = values[c].size();
    const bool any = count > 0;
    median.push_back(
        any ? cell((values[c][(count - 1) / 2] + values[c][count / 2]) / 2, columns[c].digits)
            : "");
    maximum.push_back(any ? cell(values[c].back(), columns[c].digits) : "");
  }
  table.rows.push_back(std::move(median));
  table.rows.push_back(std::move(maximum));
  return table;
}

std::string csv_of(const PlainTable& table) {
  std::string text;
  const auto add = [&](const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) text += (i == 0 ? "" : ",") + cells[i];
    text += '\n';
  };
  add(table.columns);
  for (const auto& row : table.rows) add(row);
  return text;
}

}  // namespace

BatchTables batch_tables(const BatchFolder& folder, const std::vector<BatchRun>& runs) {
  std::vector<std::pair<std::string, Json>> finished;
  BatchTables tables;
  tables.failures.title = "Failed runs";
  tables.failures.columns = {"run", "last line of its output, or why its results are not used"};
  for (const BatchRun& run : runs) {
    if (folder.has_finished(run.name)) {
      try {
        finished.emplace_back(run.name, metrics_of(folder, run.name));
      } catch (const Error& error) {
        tables.failures.rows.push_back({run.name, error.what()});
        tables.unreadable.push_back(run.name);
      }
    } else if (folder.has_failed(run.name)) {
      tables.failures.rows.push_back({run.name, folder.last_words(run.name)});
    }
  }
  tables.accuracy = table_of("Accuracy", kAccuracy, finished);
  tables.accuracy.note =
      fmt::format("{} of {} runs; reports: runs/<run>/report.html", finished.size(), runs.size());
  tables.speed = table_of("Speed", kSpeed, finished);
  return tables;
}

void write_batch_tables(const BatchFolder& folder, const BatchTables& tables) {
  Reproduction report;
  report.title = "MMS-SLAM: " + folder.path().filename().string();
  report.tables = {tables.accuracy, tables.speed};
  if (!tables.failures.rows.empty()) report.tables.push_back(tables.failures);
  write_file(folder.path() / "batch.csv", csv_of(tables.accuracy));
  write_file(folder.path() / "times.csv", csv_of(tables.speed));
  write_file(folder.path() / "report.html", reproduction_html(report));
}

}  // namespace mms
