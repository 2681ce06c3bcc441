#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace mms::testing {

/// How a run of the program ended.
struct Outcome {
  int exit_code = -1;  ///< 128 + the signal where one ended it
  std::string out;
  std::string err;
};

/// A run of the real program that goes on beside the test, in `folder`. One that was not waited for
/// is killed.
class RunningMms {
 public:
  RunningMms(const std::filesystem::path& folder, const std::vector<std::string>& arguments);
  ~RunningMms();
  RunningMms(const RunningMms&) = delete;
  RunningMms& operator=(const RunningMms&) = delete;

  void send(int signal) const;

  /// Whether it would handle `signal` itself.
  bool handles(int signal) const;

  /// Waits for its end. Reports a sanitizer finding as a failure of the test.
  Outcome wait();

 private:
  std::filesystem::path folder_;
  pid_t child_ = -1;
};

/// Runs the real program in `folder` and waits for its end. Reports a sanitizer finding as a
/// failure of the test.
Outcome run_mms(const std::filesystem::path& folder, const std::vector<std::string>& arguments);

/// Expects exit code 0, and says what the program said otherwise.
void expect_done(const Outcome& outcome);

/// Expects exit code 1 and one line "mms: ..." that has `part` in it; besides it there may be only
/// warnings and progress lines.
void expect_fault(const Outcome& outcome, const std::string& part);

/// Expects exit code 2 and one line "mms: ..." that has `part` in it.
void expect_usage_fault(const Outcome& outcome, const std::string& part);

/// Number of lines of stderr that have `part` in them.
int lines_with(const Outcome& outcome, const std::string& part);

/// Whether there is a program with libtorch, so that it can train networks.
inline constexpr bool kHasTraining = MMS_WITH_TORCH;

}  // namespace mms::testing
