#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/mms/batch/batch_folder.hpp"
#include "apps/mms/batch/batch_list.hpp"
#include "apps/mms/batch/batch_tables.hpp"
#include "apps/mms/batch/child_process.hpp"
#include "apps/mms/commands/commands.hpp"
#include "apps/mms/console/interrupt.hpp"
#include "apps/mms/console/warnings.hpp"
#include "mms/core/error.hpp"

namespace mms {
namespace {

struct BatchOptions {
  std::filesystem::path list;
  std::filesystem::path output;
  std::string shard = "1/1";
};

/// Of a run; `kThere`: its results are there already.
enum class Outcome { kThere, kFinished, kFailed, kElsewhere };

/// Does a run, unless it is done, or another process does it.
Outcome execute(const BatchFolder& folder, const BatchRun& run, const std::string& position) {
  if (folder.has_finished(run.name)) return Outcome::kThere;
  const auto claim = folder.claim(run.name);
  if (!claim) return Outcome::kElsewhere;
  if (folder.has_finished(run.name)) return Outcome::kThere;  // meanwhile
  if (folder.has_failed_meanwhile(run.name)) return Outcome::kFailed;
  fmt::print(stderr, "{} {}\n", position, run.name);
  std::vector<std::string> arguments = {"run"};
  arguments.insert(arguments.end(), run.words.begin(), run.words.end());
  arguments.insert(arguments.end(),
                   {"-o", folder.unfinished(run.name).string(), "--overwrite", "--quiet"});
  const int status = run_self(arguments, folder.log(run.name));
  if (InterruptGuard::requested()) {
    throw Interrupted("the same command goes on with the runs that are not finished");
  }
  if (status == 0) {
    folder.finish(run.name);
    return Outcome::kFinished;
  }
  folder.fail(run.name);
  print_warnings(
      {fmt::format("{} failed with status {}: {}", run.name, status, folder.last_words(run.name))});
  return Outcome::kFailed;
}

/// Writes the tables until they have all finished runs: another process may have finished one, and
/// written its tables, after these were made.
BatchTables write_tables(const BatchFolder& folder, const std::vector<BatchRun>& runs) {
  BatchTables tables = batch_tables(folder, runs);
  while (true) {
    write_batch_tables(folder, tables);
    BatchTables now = batch_tables(folder, runs);
    if (now.accuracy.rows == tables.accuracy.rows) return now;
    tables = std::move(now);
  }
}

void batch(const BatchOptions& options) {
  const std::vector<BatchRun> runs = read_batch_list(options.list);
  const Shard shard = parse_shard(options.shard);
  const BatchFolder folder(options.output);
  const InterruptGuard interrupt;
  std::size_t failed = 0;
  std::size_t elsewhere = 0;
  for (std::size_t i = shard.index; i < runs.size(); i += shard.count) {
    const Outcome outcome = execute(folder, runs[i], fmt::format("[{}/{}]", i + 1, runs.size()));
    failed += outcome == Outcome::kFailed ? 1 : 0;
    elsewhere += outcome == Outcome::kElsewhere ? 1 : 0;
    const bool is_new = outcome == Outcome::kFinished || outcome == Outcome::kFailed;
    if (is_new) write_tables(folder, runs);
  }
  const BatchTables tables = write_tables(folder, runs);
  fmt::print("{}\n{}", text_of(tables.accuracy), text_of(tables.speed));
  if (!tables.failures.rows.empty()) fmt::print("\n{}", text_of(tables.failures));
  fmt::print("\nreport: {}\n", (folder.path() / "report.html").string());
  if (elsewhere > 0) fmt::print(stderr, "{} runs are done by other processes\n", elsewhere);
  if (failed == 0 && !tables.unreadable.empty()) {
    throw DataError(
        options.list.string(),
        fmt::format("{} of its runs have results that cannot be read", tables.unreadable.size()),
        "the first is " + folder.results(tables.unreadable.front()).string());
  }
  if (failed > 0) {
    throw DataError(options.list.string(), fmt::format("{} of its runs failed", failed),
                    "their output is in " + (folder.path() / "logs").string() +
                        "; the same command tries them again");
  }
}

}  // namespace

void add_batch_command(CLI::App& app) {
  const auto options = std::make_shared<BatchOptions>();
  CLI::App* command = app.add_subcommand(
      "batch", "Run many recordings, with one table and report; continues where it was stopped");
  command
      ->add_option("LIST", options->list,
                   "text file with one run a line: DATA and options of mms run")
      ->required();
  command
      ->add_option("-o,--output", options->output,
                   "folder for the results, which several processes may share")
      ->required();
  command->add_option("--shard", options->shard, "do only every n-th run, from the i-th on")
      ->type_name("i/n")
      ->capture_default_str();
  command->callback([options] { batch(*options); });
}

}  // namespace mms
