#include "tests/program/program.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <sstream>

#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms::testing {
namespace fs = std::filesystem;
namespace {

void redirect(const fs::path& file, int descriptor) {
  const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (opened < 0 || dup2(opened, descriptor) < 0) _exit(126);
  close(opened);
}

[[noreturn]] void execute_program(const fs::path& folder, std::vector<char*>& arguments,
                                  const fs::path& out, const fs::path& err) {
  redirect(out, STDOUT_FILENO);
  redirect(err, STDERR_FILENO);
  if (chdir(folder.c_str()) != 0) _exit(126);
  // Shells let their background jobs, as these tests may be, ignore Ctrl-C.
  for (const int signal : {SIGINT, SIGTERM}) ::signal(signal, SIG_DFL);
  execv(arguments.front(), arguments.data());
  _exit(127);
}

int exit_code_of(pid_t child) {
  int status = 0;
  if (waitpid(child, &status, 0) != child) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

void expect_one_error(const Outcome& outcome, int exit_code, const std::string& part) {
  EXPECT_EQ(outcome.exit_code, exit_code) << outcome.out << outcome.err;
  int errors = 0;
  for (const std::string& line : lines_of(outcome.err)) {
    const bool progress = line.starts_with("frame ") || line.starts_with("picture ");
    const bool heading = line.starts_with("recording  ") || line.starts_with("sensor     ") ||
                         line.starts_with("results    ");
    const bool is_allowed = line.starts_with("warning: ") || progress || heading;
    EXPECT_TRUE(is_allowed || line.starts_with("mms: ")) << line;
    if (!line.starts_with("mms: ")) continue;
    ++errors;
    expect_in(part, line);
  }
  EXPECT_EQ(errors, 1) << outcome.err;
}

}  // namespace

RunningMms::RunningMms(const fs::path& folder, const std::vector<std::string>& arguments)
    : folder_(folder) {
  std::vector<std::string> words = {MMS_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  // A reader must not see the output of an earlier run, nor its truncation.
  for (const char* stream : {".stdout", ".stderr"}) fs::remove(folder / stream);
  child_ = fork();
  if (child_ == 0) execute_program(folder, pointers, folder / ".stdout", folder / ".stderr");
}

RunningMms::~RunningMms() {
  if (child_ < 0) return;
  kill(child_, SIGKILL);
  exit_code_of(child_);
}

void RunningMms::send(int signal) const {
  EXPECT_EQ(kill(child_, signal), 0) << "the program has ended";
}

Outcome RunningMms::wait() {
  Outcome outcome;
  outcome.exit_code = exit_code_of(child_);
  child_ = -1;
  outcome.out = read_file(folder_ / ".stdout");
  outcome.err = read_file(folder_ / ".stderr");
  EXPECT_EQ(lines_with(outcome, "Sanitizer"), 0) << outcome.err;
  EXPECT_EQ(lines_with(outcome, "runtime error:"), 0) << outcome.err;
  return outcome;
}

Outcome run_mms(const fs::path& folder, const std::vector<std::string>& arguments) {
  return RunningMms(folder, arguments).wait();
}

void expect_success(const Outcome& outcome) {
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
}

void expect_error(const Outcome& outcome, const std::string& part) {
  expect_one_error(outcome, 1, part);
}

void expect_usage_error(const Outcome& outcome, const std::string& part) {
  expect_one_error(outcome, 2, part);
}

int lines_with(const Outcome& outcome, const std::string& part) {
  int count = 0;
  for (const std::string& line : lines_of(outcome.err)) {
    if (line.find(part) != std::string::npos) ++count;
  }
  return count;
}

}  // namespace mms::testing
