#include "apps/mms/paper/paper_tables.hpp"

#include <fmt/core.h>

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include "mms/core/error.hpp"
#include "mms/evaluation/scores/metric_value.hpp"
#include "mms/io/text/files.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

/// A row of the paper's Table I.
struct PaperNetwork {
  std::string_view variant;
  std::string_view name;
  double ap = 0.0;
  double ms = 0.0;
};
constexpr std::array<PaperNetwork, 4> kPaperNetworks{
    {{"solov2", "SOLOv2", 38.8, 54.0},
     {"solov2+rfp", "SOLOv2 + RFP", 41.2, 64.0},
     {"solov2+sac", "SOLOv2 + SAC", 39.8, 59.0},
     {"solov2+detectors", "SOLOv2 + DetectoRS", 43.4, 71.0}}};

/// ATDE and MTDE of the paper's Table II [cm], in the order of drift_table's runs.
constexpr std::array<std::array<double, 2>, 3> kPaperDrifts{
    {{4.834, 1.877}, {1.273, 0.667}, {0.875, 0.502}}};

/// Sums over the seeds of one variant.
struct Trained {
  int seeds = 0;
  double ap = 0.0;
  double ap_person = 0.0;
  double ap_agv = 0.0;
  double ms = 0.0;
};

Trained read_training(const fs::path& folder) {
  try {
    const auto json = nlohmann::json::parse(read_file(folder / "ap.json"));
    const auto& classes = json.at("per_class");
    return {1, json.at("AP").get<double>(), classes.at("person").at("AP").get<double>(),
            classes.at("agv").at("AP").get<double>(), std::stod(read_file(folder / "ms"))};
  } catch (const std::logic_error& error) {
    throw DataError(folder.string(), std::string("is not a finished training: ") + error.what(),
                    "create it with benchmarks/table1.sh FOLDER");
  } catch (const nlohmann::json::exception& error) {
    throw DataError((folder / "ap.json").string(), error.what(),
                    "create it with benchmarks/table1.sh FOLDER");
  }
}

std::map<std::string, Trained> read_trainings(const fs::path& trainings) {
  std::map<std::string, Trained> sums;
  if (!fs::is_directory(trainings)) {
    throw FileError(trainings.string(), "is not a folder",
                    "create it with benchmarks/table1.sh FOLDER");
  }
  for (const auto& entry : fs::directory_iterator(trainings)) {
    const std::string name = entry.path().filename().string();
    if (!fs::exists(entry.path() / "ap.json")) continue;
    const Trained one = read_training(entry.path());
    Trained& sum = sums[name.substr(0, name.rfind('-'))];
    sum.seeds += 1;
    sum.ap += one.ap;
    sum.ap_person += one.ap_person;
    sum.ap_agv += one.ap_agv;
    sum.ms += one.ms;
  }
  if (sums.empty()) {
    throw DataError(trainings.string(), "has no finished training",
                    "create it with benchmarks/table1.sh FOLDER");
  }
  return sums;
}

}  // namespace

PlainTable segmentation_table(const fs::path& trainings) {
  const auto sums = read_trainings(trainings);
  PlainTable table{"Table I: instance segmentation",
                   {"network", "seeds", "AP", "AP person", "AP agv", "ms", "paper AP", "paper ms"},
                   {},
                   "Small networks on simulated images, one CPU; the paper's are ResNet-50 on COCO "
                   "with a GPU: only the order is comparable."};
  for (const PaperNetwork& paper : kPaperNetworks) {
    const auto found = sums.find(std::string(paper.variant));
    if (found == sums.end()) continue;
    const Trained& sum = found->second;
    table.rows.push_back(
        {std::string(paper.name), std::to_string(sum.seeds),
         to_fixed(100.0 * sum.ap / sum.seeds, 1), to_fixed(100.0 * sum.ap_person / sum.seeds, 1),
         to_fixed(100.0 * sum.ap_agv / sum.seeds, 1), to_fixed(sum.ms / sum.seeds, 1),
         to_fixed(paper.ap, 1), to_fixed(paper.ms, 1)});
  }
  return table;
}

PlainTable drift_table(const std::string& data, const std::vector<PaperRun>& runs) {
  PlainTable table{"Table II: drift of a static sensor [cm], " + data,
                   {"method", "ATDE (mean)", "MTDE (max)", "paper, as printed", "paper, swapped"},
                   {},
                   "A mean cannot exceed a maximum: the paper's columns are most likely swapped, "
                   "so both readings are given (mean / maximum)."};
  for (std::size_t i = 0; i < runs.size() && i < kPaperDrifts.size(); ++i) {
    const Drift& drift = runs[i].metrics.drift.value();
    const auto [first, second] = kPaperDrifts[i];
    table.rows.push_back({runs[i].name, to_fixed(100.0 * drift.atde_m, 3),
                          to_fixed(100.0 * drift.mtde_m, 3), fmt::format("{} / {}", first, second),
                          fmt::format("{} / {}", second, first)});
  }
  return table;
}

PlainTable localization_table(const std::string& data, const std::vector<PaperRun>& runs) {
  PlainTable table{"Localization against ground truth, " + data,
                   {"method", "ATE rmse [cm]", "ATE max [cm]", "RPE [cm]", "RPE [deg]", "SA [%]",
                    "DA [%]", "AA [%]"},
                   {},
                   ""};
  for (const PaperRun& run : runs) {
    if (!run.metrics.trajectory) continue;
    const TrajectoryError& error = *run.metrics.trajectory;
    std::vector<std::string> row = {run.name, to_fixed(100.0 * error.ate_rmse_m, 2),
                                    to_fixed(100.0 * error.ate_max_m, 2)};
    for (const MetricValue& value : metric_values(error)) {
      if (value.key == "rpe_trans_rmse_m") row.push_back(to_fixed(100.0 * value.value, 2));
      if (value.key == "rpe_rot_rmse_deg") row.push_back(to_fixed(value.value, 3));
    }
    for (const char* key : {"sa_pct", "da_pct", "aa_pct"}) {
      std::string cell = "-";
      if (run.metrics.map) {
        for (const MetricValue& value : metric_values(*run.metrics.map)) {
          if (value.key == key) cell = to_fixed(value.value, 1);
        }
      }
      row.push_back(cell);
    }
    table.rows.push_back(row);
  }
  return table;
}

PlainTable stage_table(const std::vector<PaperRun>& runs) {
  PlainTable table{
      "Time per frame [ms, mean]", {"method"}, {}, "Stages of consecutive frames overlap."};
  if (runs.empty()) return table;
  for (const auto& [name, times] : runs.front().metrics.stages) table.columns.push_back(name);
  table.columns.insert(table.columns.end(), {"whole", "p99", "frames/s"});
  for (const PaperRun& run : runs) {
    std::vector<std::string> row = {run.name};
    for (const auto& [name, times] : run.metrics.stages) row.push_back(to_fixed(times.mean, 1));
    row.push_back(to_fixed(run.metrics.ms_per_frame.mean, 1));
    row.push_back(to_fixed(run.metrics.ms_per_frame.p99, 1));
    row.push_back(to_fixed(run.metrics.rate_hz, 1));
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace mms
