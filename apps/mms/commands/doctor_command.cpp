#include "apps/mms/commands/commands.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
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

void print_machine() {
  const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                        static_cast<double>(sysconf(_SC_PAGE_SIZE)) / (1024.0 * 1024.0 * 1024.0);
  fmt::print("mms {} built with compiler {}\n", MMS_VERSION, __VERSION__);
  fmt::print("cores   {}\nmemory  {:.1f} GiB\n", std::thread::hardware_concurrency(), memory);
}

bool check(const std::string& what, const std::string& fault) {
  fmt::print("{:<44} {}\n", what, fault.empty() ? "ok" : "FAILED: " + fault);
  return fault.empty();
}

/// Tracks a few simulated frames.
/// @returns the fault; empty if none
std::string trial_run() {
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
  fmt::print("{:<44} {:.1f} ms/frame, sequential on one thread\n", "speed without network",
             1000.0 * (elapsed.count() - read_seconds) / kTrialFrames);
  return "";
}

/// Segments a simulated frame with the default network.
std::string network_trial() {
  try {
    const std::unique_ptr<Detector> detector = make_detector({});
    const auto frame = open_dataset("sim:crowd?frames=1")->next();
    detector->detect(frame->color);  // warm-up
    const auto start = std::chrono::steady_clock::now();
    const std::size_t objects = detector->detect(frame->color).size();
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - start;
    fmt::print("{:<44} {:.1f} ms/image, one thread\n", "speed of the network", elapsed.count());
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
  command->callback([] {
    print_machine();
    const bool tracked = check("tracking in a simulated warehouse", trial_run());
    const bool segmented = check("person detection by the network", network_trial());
    const bool writable = check("writing to the working directory", write_trial());
    if (!tracked || !segmented || !writable)
      throw Error("doctor", "a check failed", "see the lines above");
  });
}

}  // namespace mms
