#include "apps/mms/commands/commands.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "mms/core/error.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/pipeline/slam_system.hpp"
#include "mms/run/segmenter/network_detector.hpp"
#include "mms/segmentation/segmenters/mask_segmenter.hpp"

namespace mms {
namespace {

constexpr int kTrialFrames = 10;

/// Prints each result immediately, or all as one JSON object at the end.
class DoctorReport {
 public:
  explicit DoctorReport(bool json) : json_(json) {
    const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                          static_cast<double>(sysconf(_SC_PAGE_SIZE)) / (1024.0 * 1024.0 * 1024.0);
    const unsigned cores = std::thread::hardware_concurrency();
    report_ = {{"version", MMS_VERSION},
               {"compiler", __VERSION__},
               {"cores", cores},
               {"memory_gib", memory},
               {"ok", true},
               {"checks", Json::array()}};
    if (json_) return;
    fmt::print("mms {} built with compiler {}\n", MMS_VERSION, __VERSION__);
    fmt::print("cores   {}\nmemory  {:.1f} GiB\n", cores, memory);
  }

  /// @param key  with its unit
  void time(const char* key, const std::string& what, double milliseconds, const std::string& per) {
    report_[key] = milliseconds;
    if (!json_) fmt::print("{:<44} {:.1f} {}\n", what, milliseconds, per);
  }

  void check(const std::string& what, const std::string& fault) {
    report_["checks"].push_back({{"name", what}, {"ok", fault.empty()}, {"fault", fault}});
    if (!fault.empty()) report_["ok"] = false;
    if (!json_) fmt::print("{:<44} {}\n", what, fault.empty() ? "ok" : "FAILED: " + fault);
  }

  /// @throws Error if a check failed.
  void finish() const {
    if (json_) fmt::print("{}\n", report_.dump(2, ' ', false, Json::error_handler_t::replace));
    if (!report_["ok"]) throw Error("doctor", "a check failed", "see the lines above");
  }

 private:
  using Json = nlohmann::ordered_json;

  bool json_;
  Json report_;
};

/// Tracks a few simulated frames.
/// @returns the fault; empty if none
std::string trial_run(DoctorReport& report) {
  const auto source = open_dataset(fmt::format("sim:rack_aisle?frames={}", kTrialFrames));
  SlamSystem system({}, std::make_unique<MaskSegmenter>());
  const auto start = std::chrono::steady_clock::now();
  double read_seconds = 0.0;
  while (true) {
    const auto before = std::chrono::steady_clock::now();
    const auto frame = source->next();
    read_seconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
    if (!frame) break;
    if (system.process(*frame).odometry.status == Status::kLost) return "lost track";
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  report.time("time_per_frame_ms", "speed without network",
              1000.0 * (elapsed.count() - read_seconds) / kTrialFrames,
              "ms/frame, sequential on one thread");
  return "";
}

/// Segments a simulated frame with the default network.
std::string network_trial(DoctorReport& report) {
  try {
    const std::unique_ptr<Detector> detector = make_detector({});
    const auto frame = open_dataset("sim:crowd?frames=1")->next();
    detector->detect(frame->color);  // warm-up
    const auto start = std::chrono::steady_clock::now();
    const std::size_t objects = detector->detect(frame->color).size();
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - start;
    report.time("network_time_per_image_ms", "speed of the network", elapsed.count(),
                "ms/image, one thread");
    return objects > 0 ? "" : "detected no person in a crowd";
  } catch (const Error& error) {
    return error.what();
  }
}

std::string write_trial() {
  try {
    const std::filesystem::path probe = "mms-doctor-probe";
    write_file(probe, std::string_view("x"));
    std::filesystem::remove(probe);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

}  // namespace

void add_doctor_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("doctor", "Check that the program works on this machine");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "print one JSON object");
  command->callback([json] {
    DoctorReport report(*json);
    report.check("tracking in a simulated warehouse", trial_run(report));
    report.check("person detection by the network", network_trial(report));
    report.check("writing to the working directory", write_trial());
    report.finish();
  });
}

}  // namespace mms
