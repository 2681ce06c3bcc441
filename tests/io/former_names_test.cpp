#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/io/config/config_assignments.hpp"
#include "mms/io/config/config_yaml.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::expect_in;
using testing::message_of;
using testing::TempFolder;

struct Inner {
  double scale = 1.0;
  void visit(ConfigVisitor& v) {
    v.number({"scale", "m", "of the residuals", "slack"}, scale, {0.0, 5.0});
  }
};

struct Outer {
  Inner motion;
  std::vector<Inner> items;
  void visit(ConfigVisitor& v) {
    v.group({"motion", "", "a group", "movement"}, motion);
    v.list({"items", "", "a list", "things"}, items);
  }
};

std::vector<std::string> load(const std::string& yaml, Outer& config) {
  const TempFolder folder;
  return load_config(folder.write("c.yaml", yaml), config);
}

TEST(FormerNames, OfFieldAreReadWithWarning) {
  Outer config;
  const auto warnings = load("motion:\n  slack: 2\n", config);
  EXPECT_EQ(config.motion.scale, 2.0);
  ASSERT_EQ(warnings.size(), 1U);
  expect_in("c.yaml:2: motion.slack is now called motion.scale", warnings[0]);
}

TEST(FormerNames, OfGroupAreReadWithWarning) {
  Outer config;
  const auto warnings = load("movement:\n  scale: 3\n", config);
  EXPECT_EQ(config.motion.scale, 3.0);
  ASSERT_EQ(warnings.size(), 1U);
  expect_in("movement is now called motion", warnings[0]);
}

TEST(FormerNames, OfListsAndItemsAreRead) {
  Outer config;
  const auto warnings = load("things:\n  - slack: 4\n  - scale: 5\n", config);
  ASSERT_EQ(config.items.size(), 2U);
  EXPECT_EQ(config.items[0].scale, 4.0);
  EXPECT_EQ(config.items[1].scale, 5.0);
  EXPECT_EQ(warnings.size(), 2U);
}

TEST(FormerNames, PresentNamesGiveNoWarning) {
  Outer config;
  EXPECT_TRUE(load("motion:\n  scale: 2\n", config).empty());
  EXPECT_EQ(dump_config(config).find("slack"), std::string::npos);
}

TEST(FormerNames, RejectsBothNamesTogether) {
  Outer config;
  const std::string message =
      message_of<ConfigError>([&] { load("motion:\n  scale: 2\n  slack: 3\n", config); });
  expect_in("slack is the former name of motion.scale", message);
  EXPECT_EQ(config.motion.scale, 1.0);
}

TEST(FormerNames, RangeErrorsUsePresentName) {
  Outer config;
  const std::string message =
      message_of<ConfigError>([&] { load("motion:\n  slack: 9\n", config); });
  expect_in("motion.scale", message);
}

TEST(FormerNames, AreAssignedWithWarning) {
  Outer config;
  const std::vector<std::string> field = {"motion.slack=2"};
  EXPECT_EQ(assign(config, field, "--set"),
            std::vector<std::string>{"--set: motion.slack is now called motion.scale"});
  EXPECT_EQ(config.motion.scale, 2.0);
  const std::vector<std::string> group = {"movement.scale=3"};
  EXPECT_EQ(assign(config, group, "--set").size(), 1U);
  EXPECT_EQ(config.motion.scale, 3.0);
  const std::vector<std::string> both = {"movement.slack=4"};
  EXPECT_EQ(assign(config, both, "--set").size(), 2U);
  EXPECT_EQ(config.motion.scale, 4.0);
}

}  // namespace
}  // namespace mms
