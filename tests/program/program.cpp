#include "tests/program/program.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <sstream>

#include "mms/io/files.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms::testing {
namespace fs = std::filesystem;
namespace {

void redirect(const fs::path& file, int descriptor) {
  const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (opened < 0 || dup2(opened, descriptor) < 0) _exit(126);
  close(opened);
}

[[noreturn]] void become_program(const fs::path& folder, std::vector<char*>& arguments,
                                 const fs::path& out, const fs::path& err) {
  redirect(out, STDOUT_FILENO);
  redirect(err, STDERR_FILENO);
  if (chdir(folder.c_str()) != 0) _exit(126);
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
    const bool aside = line.starts_with("warning: ") || line.starts_with("frame ");
    EXPECT_TRUE(aside || line.starts_with("mms: ")) << line;
    if (!line.starts_with("mms: ")) continue;
    ++errors;
    expect_in(part, line);
  }
  EXPECT_EQ(errors, 1) << outcome.err;
}

}  // namespace

Outcome run_mms(const fs::path& folder, const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {MMS_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const fs::path out = folder / ".stdout";
  const fs::path err = folder / ".stderr";
  const pid_t child = fork();
  if (child == 0) become_program(folder, pointers, out, err);
  Outcome outcome;
  outcome.exit_code = exit_code_of(child);
  outcome.out = read_file(out);
  outcome.err = read_file(err);
  EXPECT_EQ(lines_with(outcome, "Sanitizer"), 0) << outcome.err;
  EXPECT_EQ(lines_with(outcome, "runtime error:"), 0) << outcome.err;
  return outcome;
}

void expect_done(const Outcome& outcome) {
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
}

void expect_fault(const Outcome& outcome, const std::string& part) {
  expect_one_error(outcome, 1, part);
}

void expect_usage_fault(const Outcome& outcome, const std::string& part) {
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
