// Replays the seeds of all fuzz targets, former findings (corpus/TARGET/*), and damaged seeds.
// benchmarks/fuzz.sh tries more, guided by coverage.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "mms/core/error.hpp"
#include "mms/io/text/files.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/support/memory_limit.hpp"

namespace mms::testing {

/// GoogleTest prints the bytes of an unknown type, with padding.
static void PrintTo(const FuzzTarget& target, std::ostream* out) {
  *out << target.name;
}

}  // namespace mms::testing

namespace mms {
namespace {

using testing::FuzzTarget;
namespace fs = std::filesystem;

constexpr auto kHang = std::chrono::seconds(5);

/// Damaged inputs of each target; MMS_FUZZ_INPUTS sets another number.
unsigned damaged_inputs() {
  const char* given = std::getenv("MMS_FUZZ_INPUTS");
  return given == nullptr ? 1000U : static_cast<unsigned>(std::atol(given));
}

/// What is read now, for the message of a crash.
char now[200];  // NOLINT: read by a signal handler

void on_crash(int signal) {
  static_cast<void>(!write(STDERR_FILENO, now, strnlen(now, sizeof now)));
  std::signal(signal, SIG_DFL);
  static_cast<void>(std::raise(signal));
}

class Fuzz : public ::testing::TestWithParam<FuzzTarget> {
 protected:
  static void SetUpTestSuite() {
#ifndef __SANITIZE_ADDRESS__  // which has its own
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
      std::signal(signal, on_crash);
    }
#endif
  }

  void expect_survived(const std::string& bytes, const std::string& what) const {
    std::snprintf(now, sizeof now, "reading %s, %s\n", GetParam().name.c_str(), what.c_str());
    const auto start = std::chrono::steady_clock::now();
    try {
      GetParam().read(bytes);
    } catch (const Error& error) {
      EXPECT_GT(std::string(error.what()).size(), 5U) << what;
    } catch (const std::exception& error) {
      ADD_FAILURE() << what << ": " << error.what();
    }
    EXPECT_LT(std::chrono::steady_clock::now() - start, kHang) << what;
  }
};

TEST_P(Fuzz, SurvivesDamagedInput) {
  const std::vector<std::string> seeds = GetParam().seeds();
  ASSERT_FALSE(seeds.empty());
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    ASSERT_FALSE(seeds[i].empty());
    expect_survived(seeds[i], "seed " + std::to_string(i));
  }
  const testing::MemoryLimit limit;
  const fs::path corpus = fs::path(MMS_SOURCE_DIR) / "tests/fuzz/corpus" / GetParam().name;
  if (fs::exists(corpus)) {
    for (const std::string& name : list_folder(corpus)) {
      expect_survived(read_file(corpus / name), name);
    }
  }
  for (unsigned i = 0; i < damaged_inputs(); ++i) {
    expect_survived(testing::damaged(seeds, i), "damaged input " + std::to_string(i));
  }
}

/// A valid input of each target is read without an error by at least one of its readers.
TEST_P(Fuzz, ReadsASeed) {
  const std::vector<std::string> seeds = GetParam().seeds();
  std::string last;
  const bool read = std::any_of(seeds.begin(), seeds.end(), [&](const std::string& seed) {
    try {
      GetParam().read(seed);
      return true;
    } catch (const Error& error) {
      last = error.what();
      return false;
    }
  });
  EXPECT_TRUE(read) << last;
}

INSTANTIATE_TEST_SUITE_P(Targets, Fuzz, ::testing::ValuesIn(testing::fuzz_targets()),
                         [](const auto& parameter) { return parameter.param.name; });

}  // namespace
}  // namespace mms
