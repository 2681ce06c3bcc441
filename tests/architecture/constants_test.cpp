#include <gtest/gtest.h>

#include "tests/architecture/constant_rules.hpp"

namespace mms {
namespace {

using testing::constant_faults;

constexpr const char* kCheckedFolders[] = {"mms/localization", "mms/fusion", "mms/mapping",
                                           "mms/pipeline", "mms/global_map"};

std::vector<std::string> faults_of(const std::string& source) {
  return constant_faults("a.cpp", source);
}

using Faults = std::vector<std::string>;

TEST(Constants, AllOfTheCheckedModulesHaveUnitAndSource) {
  std::string all;
  for (const std::string& fault : constant_faults(MMS_SOURCE_DIR, kCheckedFolders)) {
    all += fault + "\n";
  }
  EXPECT_TRUE(all.empty()) << all;
}

TEST(Constants, AcceptsCommentAboveOrBehind) {
  EXPECT_EQ(faults_of("/// [m]: gap between neighbors.\n"
                      "/// Source: three sigma of the depth noise at 4 m.\n"
                      "constexpr float kGap = 0.1F;\n"
                      "constexpr int kRounds = 5;  ///< [-]: rounds. Source: converges in three.\n"
                      "inline constexpr double kGravity = 9.81;  // [m/s^2]: standard gravity.\n"
                      "                                          // Source: ISO 80000-3.\n"
                      "/// [m, rad]: noise of a pose.\n"
                      "constexpr double kNoise = 0.003;  ///< Source: residuals at rest.\n"),
            Faults{});
}

TEST(Constants, CatchesConstantWithoutComment) {
  EXPECT_EQ(faults_of("\nconstexpr float kGap = 0.1F;\n"), Faults{"a.cpp:2: kGap has no comment"});
}

TEST(Constants, CatchesConstantWithoutUnit) {
  EXPECT_EQ(faults_of("/// Gap. Source: measured.\nconstexpr float kGap = 0.1F;\n"),
            Faults{"a.cpp:2: kGap lacks unit"});
  EXPECT_EQ(faults_of("/// In [0, 255]. Source: measured.\nconstexpr float kGrey = 9.0F;\n"),
            Faults{"a.cpp:2: kGrey lacks unit"});
}

TEST(Constants, CatchesConstantWithoutSource) {
  EXPECT_EQ(faults_of("constexpr float kGap = 0.1F;  ///< [m]: gap\n"),
            Faults{"a.cpp:1: kGap lacks source"});
  EXPECT_EQ(faults_of("constexpr float kGap = 0.1F;  ///< gap. Source:\n"),
            Faults{"a.cpp:1: kGap lacks unit, source"});
}

TEST(Constants, EachNeedsItsOwnComment) {
  const std::string good = "/// [m]: gap. Source: measured.\nconstexpr float kGap = 0.1F;\n";
  EXPECT_EQ(faults_of(good + "constexpr float kReach = 0.4F;\n"),
            Faults{"a.cpp:3: kReach has no comment"});
  EXPECT_EQ(faults_of("/// [m]: gap. Source: measured.\n\nconstexpr float kGap = 0.1F;\n"),
            Faults{"a.cpp:3: kGap has no comment"});
  EXPECT_EQ(faults_of("constexpr float kGap = 0.1F;\n" + good),
            Faults{"a.cpp:1: kGap has no comment"});
}

TEST(Constants, CatchesArraysAndDerivedNumbers) {
  EXPECT_EQ(faults_of("constexpr std::array<Rgb, 2> kColors = {\n    {{0, 0, 0}, {255, 0, 0}}};\n"),
            Faults{"a.cpp:1: kColors has no comment"});
  EXPECT_EQ(faults_of("const double kMinCosine = std::cos(kAngle);\n"),
            Faults{"a.cpp:1: kMinCosine has no comment"});
  EXPECT_EQ(faults_of("constexpr int kSides[] = {kA, kB};\n"),
            Faults{"a.cpp:1: kSides has no comment"});
  EXPECT_EQ(faults_of("constexpr auto kGap = 2.0F * kHalf;\n"),
            Faults{"a.cpp:1: kGap has no comment"});
  EXPECT_EQ(faults_of("constexpr std::array<float, 2>\n    kGaps = {1.0F, 2.0F};\n").size(), 1U);
}

TEST(Constants, AcceptsWhatIsNoNumber) {
  EXPECT_EQ(faults_of("constexpr float kNan = std::numeric_limits<float>::quiet_NaN();\n"
                      "constexpr float kInfinity = std::numeric_limits<float>::infinity();\n"
                      "constexpr std::array<std::string_view, 2> kNames = {\"a 1\", \"b\"};\n"
                      "constexpr char kTitle[] = \"8 of 9\";\n"
                      "constexpr double square(double x) {\n  return 1.0 * x * x;\n}\n"
                      "const Rules& rules();\n"
                      "void f() {\n  constexpr int kLocal = 3;\n}\n"),
            Faults{});
}

}  // namespace
}  // namespace mms
