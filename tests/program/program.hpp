#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

namespace mms::testing {

/// Result of a run of the program.
struct Outcome {
  int exit_code = -1;  ///< 128 + the signal that ended it, if any
  std::string out;
  std::string err;
};

/// A run of the real program in `folder` concurrent to the test. The destructor kills it unless it
/// was waited for.
class RunningMms {
 public:
  RunningMms(const std::filesystem::path& folder, const std::vector<std::string>& arguments);
  ~RunningMms();
  RunningMms(const RunningMms&) = delete;
  RunningMms& operator=(const RunningMms&) = delete;

  void send(int signal) const;

  /// Waits for its end. A sanitizer finding fails the test.
  Outcome wait();

 private:
  std::filesystem::path folder_;
  pid_t child_ = -1;
};

/// Runs the real program in `folder` and waits for its end. A sanitizer finding fails the test.
Outcome run_mms(const std::filesystem::path& folder, const std::vector<std::string>& arguments);

/// Expects exit code 0, and prints the program's output otherwise.
void expect_success(const Outcome& outcome);

/// Expects exit code 1 and one line "mms: ..." that contains `part`, beside warnings and progress
/// lines.
void expect_error(const Outcome& outcome, const std::string& part);

/// Expects exit code 2 and one line "mms: ..." that contains `part`.
void expect_usage_error(const Outcome& outcome, const std::string& part);

/// Waits, up to a minute, until `done()`; false if it never is.
template <class Condition>
bool wait_until(const Condition& done) {
  using namespace std::chrono_literals;
  for (int i = 0; i < 30000; ++i) {
    if (done()) return true;
    std::this_thread::sleep_for(2ms);
  }
  return false;
}

/// Number of lines of stderr that contain `part`.
int lines_with(const Outcome& outcome, const std::string& part);

/// Whether the program is built with libtorch, which training needs.
inline constexpr bool kHasTraining = MMS_WITH_TORCH;

}  // namespace mms::testing
