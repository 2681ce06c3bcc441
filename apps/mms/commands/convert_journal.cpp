#include "apps/mms/commands/convert_journal.hpp"

#include <fmt/chrono.h>
#include <fmt/core.h>

#include "apps/mms/console/overwrite_option.hpp"
#include "mms/core/error.hpp"
#include "mms/io/text/files.hpp"
#include "mms/run/record/recovered_run.hpp"
#include "mms/run/results/result_files.hpp"

namespace mms {
namespace {

constexpr const char* kRecoveredFiles[] = {"trajectory.tum", "trajectory_kitti.txt",
                                           "keyframes.tum", "static_map.ply", "static_map.pcd"};

namespace fs = std::filesystem;

fs::path journal_of(const fs::path& input) {
  if (!fs::is_directory(input)) return input;
  fs::path journal = input / kJournalName;
  if (fs::exists(journal)) return journal;
  const bool done = fs::exists(input / "trajectory.tum");
  throw DataError(
      input.string(), "has no journal.bin",
      done ? "the run was completed: trajectory and map exist"
           : "a recording becomes a bag by -o x.bag or x.mcap; only a killed run has a journal");
}

/// "2026-03-01 12:30:01.250 UTC".
std::string date_of(Timestamp wall) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  const auto seconds = static_cast<std::time_t>(wall.nanoseconds() / kSecond);
  std::tm parts{};
  if (gmtime_r(&seconds, &parts) == nullptr || wall.nanoseconds() < 0) return "an unknown time";
  return fmt::format("{:%Y-%m-%d %H:%M:%S}.{:03} UTC", parts,
                     wall.nanoseconds() % kSecond / 1'000'000);
}

void print_summary(const RecoveredRun& run, const fs::path& folder) {
  fmt::print("{}: {} frames up to stamp {}, written {}\n", run.header.data, run.trajectory.size(),
             run.trajectory.back().stamp.to_string(), date_of(run.written));
  fmt::print("{} keyframes, {} map points\n", run.keyframes.size(), run.map.size());
  if (!run.damage.empty()) fmt::print("later frames are lost: {}\n", run.damage);
  fmt::print("trajectory: {}\nmap:        {}\n", (folder / "trajectory.tum").string(),
             (folder / "static_map.ply").string());
}

}  // namespace

void convert_journal(const fs::path& input, const fs::path& output, bool overwrite) {
  const fs::path journal = journal_of(input);
  const RecoveredRun run = recover_run(journal);
  const fs::path folder = output.empty() ? journal.parent_path() : output;
  for (const char* file : kRecoveredFiles) refuse_existing_file(folder / file, overwrite);
  if (!folder.empty()) make_folder(folder);
  write_result_files(folder, run.trajectory, run.keyframes, run.map,
                     run.organised ? MapFrame::kCamera : MapFrame::kLidar);
  print_summary(run, folder);
}

}  // namespace mms
