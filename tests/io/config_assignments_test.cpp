#include "mms/io/config/config_assignments.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "mms/core/error.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::expect_in;
using testing::message_of;

struct Inner {
  bool enabled = false;
  void visit(ConfigVisitor& v) { v.boolean({"enabled", "", "whether"}, enabled); }
};

struct Outer {
  double speed = 1.0;
  int count = 2;
  int color = 0;
  Inner group;
  void visit(ConfigVisitor& v) {
    static constexpr std::array<std::string_view, 2> kColors = {"red", "green"};
    v.number({"speed", "m/s", "how fast"}, speed, {0.0, 5.0});
    v.integer({"count", "", "how many"}, count, {1.0});
    v.choice({"color", "", "which"}, color, kColors);
    v.group({"group", "", "more"}, group);
  }
};

Outer assigned(const std::vector<std::string>& texts) {
  Outer config;
  assign(config, texts, "--set");
  return config;
}

std::string error_of(const std::string& text) {
  const std::string message = message_of<DataError>([&] { assigned({text}); });
  expect_in("--set: ", message);
  return message;
}

TEST(ConfigAssignments, SetFieldsOfEveryType) {
  const Outer config = assigned({"speed=2.5", "count=7", "color=green", "group.enabled=true"});
  EXPECT_EQ(config.speed, 2.5);
  EXPECT_EQ(config.count, 7);
  EXPECT_EQ(config.color, 1);
  EXPECT_TRUE(config.group.enabled);
}

TEST(ConfigAssignments, LastAssignmentCounts) {
  EXPECT_EQ(assigned({"count=3", "count=4"}).count, 4);
}

TEST(ConfigAssignments, ErrorsExplainProblem) {
  expect_in("'speed' is not key=value", error_of("speed"));
  expect_in("unknown key 'sped' (did you mean 'speed'?)", error_of("sped=1"));
  expect_in("unknown key 'x' (known: speed, count, color, group.enabled)", error_of("x=1"));
  expect_in("speed is '9', allowed: 0 to 5", error_of("speed=9"));
  expect_in("speed is 'nan'", error_of("speed=nan"));
  expect_in("count is '1.5', allowed: at least 1", error_of("count=1.5"));
  expect_in("count is '3000000000'", error_of("count=3000000000"));
  expect_in("color cannot be 'gren' (did you mean 'green'?)", error_of("color=gren"));
  expect_in("group.enabled is 'yes', allowed: true, false", error_of("group.enabled=yes"));
}

TEST(ConfigAssignments, FailedAssignmentKeepsConfig) {
  Outer config;
  const std::vector<std::string> texts = {"count=7", "speed=9"};
  message_of<DataError>([&] { assign(config, texts, "x"); });
  EXPECT_EQ(config.count, 2);
}

}  // namespace
}  // namespace mms
