#include "mms/pipeline/system_config.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <set>
#include <string>
#include <vector>

namespace mms {
namespace {

/// Checks every field it visits.
class Checker : public ConfigVisitor {
 public:
  void number(const FieldInfo& info, double& value, Range range) override {
    expect_within(info, value, range);
    expect_own(info, &value);
  }
  void integer(const FieldInfo& info, int& value, Range range) override {
    expect_within(info, value, range);
    expect_own(info, &value);
  }
  void boolean(const FieldInfo& info, bool& value) override {
    expect_sound(info);
    expect_own(info, &value);
  }
  void choice(const FieldInfo& info, int& index,
              std::span<const std::string_view> choices) override {
    expect_sound(info);
    EXPECT_GE(choices.size(), 2U) << path(info);
    EXPECT_GE(index, 0) << path(info);
    EXPECT_LT(index, static_cast<int>(choices.size())) << path(info);
    const std::set<std::string_view> different(choices.begin(), choices.end());
    EXPECT_EQ(different.size(), choices.size()) << path(info);
  }

  void text(const FieldInfo& info, std::string&) override { expect_sound(info); }

  const std::set<std::string>& paths() const { return paths_; }
  std::size_t open_groups() const { return groups_.size(); }

 protected:
  void begin_group(const FieldInfo& info) override {
    expect_sound(info);
    groups_.emplace_back(info.key);
  }
  void end_group() override {
    ASSERT_FALSE(groups_.empty());
    groups_.pop_back();
  }

 private:
  std::string path(const FieldInfo& info) const {
    std::string result;
    for (const std::string& group : groups_) result += group + ".";
    return result + std::string(info.key);
  }

  void expect_sound(const FieldInfo& info) {
    EXPECT_TRUE(paths_.insert(path(info)).second) << path(info) << " appears twice";
    EXPECT_FALSE(info.key.empty());
    EXPECT_FALSE(info.doc.empty()) << path(info);
    for (const char c : info.key) {
      EXPECT_TRUE(std::islower(c) || std::isdigit(c) || c == '_') << path(info);
    }
    EXPECT_EQ(info.doc.find('\n'), std::string_view::npos) << path(info);
  }

  void expect_within(const FieldInfo& info, double value, Range range) {
    expect_sound(info);
    EXPECT_LT(range.min, range.max) << path(info);
    EXPECT_GE(value, range.min) << path(info);
    EXPECT_LE(value, range.max) << path(info);
  }

  void expect_own(const FieldInfo& info, const void* value) {
    EXPECT_TRUE(values_.insert(value).second) << path(info) << " shares its value with another key";
  }

  std::vector<std::string> groups_;
  std::set<std::string> paths_;
  std::set<const void*> values_;
};

TEST(SystemConfig, HasUniqueKeysAndDefaultsWithinRanges) {
  SystemConfig config;
  Checker checker;
  config.visit(checker);
  EXPECT_EQ(checker.open_groups(), 0U);
  EXPECT_GT(checker.paths().size(), 50U);
}

TEST(SystemConfig, HasAGroupForEachModule) {
  SystemConfig config;
  Checker checker;
  config.visit(checker);
  for (const char* path :
       {"depth_noise.base", "fusion.mode", "features.edge_smoothness", "odometry.min_inliers",
        "odometry.registration.geometric.association", "odometry.registration.photometric.enabled",
        "keyframes.translation", "static_map.voxel_size", "dynamic_map.max_missed"}) {
    EXPECT_TRUE(checker.paths().contains(path)) << path;
  }
}

}  // namespace
}  // namespace mms
