#include "mms/simulation/sensors/mask_errors.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace mms {
namespace {

using Mask = Image<std::uint8_t>;
const std::vector<ObjectClass> kClasses{ObjectClass::kPerson, ObjectClass::kAgv,
                                        ObjectClass::kPerson};

void fill(Mask& mask, int x0, int y0, int width, int height, std::uint8_t value) {
  for (int y = y0; y < y0 + height; ++y) {
    for (int x = x0; x < x0 + width; ++x) mask(x, y) = value;
  }
}

/// Three boxes, the first two side by side.
Mask scene(int width = 640) {
  Mask instances(width, width * 3 / 4);
  const int unit = width / 64;
  fill(instances, 8 * unit, 8 * unit, 12 * unit, 30 * unit, 1);
  fill(instances, 20 * unit, 12 * unit, 16 * unit, 20 * unit, 2);
  fill(instances, 44 * unit, 10 * unit, 14 * unit, 25 * unit, 3);
  return instances;
}

/// A configuration with all errors zero.
MaskErrorConfig none() {
  MaskErrorConfig config;
  config.enabled = true;
  config.missed = config.erosion = config.boundary_jitter = config.lost_parts = config.spill = 0.0;
  return config;
}

int count(const Mask& mask, std::uint8_t value) {
  return static_cast<int>(std::count(mask.pixels().begin(), mask.pixels().end(), value));
}

Mask exact(const Mask& instances) {
  Mask labels = instances;
  for (std::uint8_t& value : labels.pixels()) value = value == 3 ? 1 : value;
  return labels;
}

TEST(MaskErrors, AreExactWhenDisabledOrZero) {
  MaskErrorConfig config;
  EXPECT_FALSE(config.enabled);
  for (const int index : {0, 5, 99}) {
    EXPECT_EQ(imperfect_masks(scene(), kClasses, config, 1, index).pixels(),
              exact(scene()).pixels());
    EXPECT_EQ(imperfect_masks(scene(), kClasses, none(), 1, index).pixels(),
              exact(scene()).pixels());
  }
}

TEST(MaskErrors, OmitUnknownObjects) {
  const std::vector<ObjectClass> two{ObjectClass::kPerson, ObjectClass::kAgv};
  for (const bool enabled : {false, true}) {
    MaskErrorConfig config = none();
    config.enabled = enabled;
    const Mask labels = imperfect_masks(scene(), two, config, 1, 0);
    EXPECT_EQ(labels(500, 200), 0);
    EXPECT_EQ(labels(100, 200), 1);
  }
  EXPECT_TRUE(imperfect_masks(Mask(), kClasses, none(), 1, 0).empty());
}

struct Gaps {
  double share = 0.0;
  double mean = 0.0;  ///< length [frames]
};

/// Gaps of small objects over many frames.
Gaps gaps_of(const MaskErrorConfig& config) {
  constexpr int kFrames = 3000;
  constexpr int kObjects = 20;
  Mask instances(kObjects, 1);
  for (int i = 0; i < kObjects; ++i) instances(i, 0) = static_cast<std::uint8_t>(i + 1);
  const std::vector<ObjectClass> classes(kObjects, ObjectClass::kAgv);
  std::vector<bool> before(kObjects, false);
  int missed = 0;
  int started = 0;
  for (int index = 0; index < kFrames; ++index) {
    const Mask labels = imperfect_masks(instances, classes, config, 3, index);
    for (int i = 0; i < kObjects; ++i) {
      const bool gap = labels(i, 0) == 0;
      missed += gap ? 1 : 0;
      started += gap && !before[static_cast<std::size_t>(i)] ? 1 : 0;
      before[static_cast<std::size_t>(i)] = gap;
    }
  }
  return {static_cast<double>(missed) / (kFrames * kObjects),
          static_cast<double>(missed) / started};
}

TEST(MaskErrors, GapsHaveConfiguredShareAndLength) {
  for (const double share : {0.02, 0.15, 0.5, 0.8}) {
    for (const double spell : {1.0, 4.0, 12.0}) {
      MaskErrorConfig config = none();
      config.missed = share;
      config.spell = spell;
      const Gaps gaps = gaps_of(config);
      EXPECT_NEAR(gaps.share, share, 0.03 * share + 0.001) << share << " " << spell;
      const double possible = std::max(spell, share / (1.0 - share));
      EXPECT_NEAR(gaps.mean, possible, 0.1 * possible + 0.1) << share << " " << spell;
    }
  }
}

TEST(MaskErrors, MissObjectsIndependently) {
  MaskErrorConfig config = none();
  config.missed = 0.5;
  std::set<std::vector<bool>> seen;
  for (int index = 0; index < 200; ++index) {
    const Mask labels = imperfect_masks(scene(128), kClasses, config, 1, index);
    seen.insert({labels(20, 40) != 0, labels(60, 40) != 0, labels(100, 40) != 0});
  }
  EXPECT_EQ(seen.size(), 8U);
}

class MaskWidth : public testing::TestWithParam<int> {};

TEST_P(MaskWidth, ErosionScalesWithImageWidth) {
  const int width = GetParam();
  Mask instances(width, width * 3 / 4);
  const int side = width / 2;
  fill(instances, width / 4, width / 8, side, side, 1);
  MaskErrorConfig config = none();
  for (const double erosion : {2.0, 4.0}) {
    for (const double boundary_jitter : {0.0, 2.0}) {
      config.erosion = erosion;
      config.boundary_jitter = boundary_jitter;
      double retreat = 0.0;
      constexpr int kFrames = 12;
      for (int i = 0; i < kFrames; ++i) {
        const int remaining = count(imperfect_masks(instances, kClasses, config, 1, 7 * i), 1);
        retreat += 0.5 * (side - std::sqrt(remaining)) / kFrames * 640.0 / width;
      }
      EXPECT_NEAR(retreat, erosion, 0.08 * erosion + 0.1) << boundary_jitter;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, MaskWidth, testing::Values(320, 640, 1280));

TEST(MaskErrors, JitteredBoundariesChangeSlowly) {
  MaskErrorConfig config = none();
  config.erosion = config.boundary_jitter = 4.0;
  const auto left_boundary = [&](int index) {
    const Mask labels = imperfect_masks(scene(), kClasses, config, 1, index);
    std::vector<int> columns;
    for (int y = 130; y < 320; ++y) {
      int x = 440;
      while (labels(x, y) == 0) ++x;
      columns.push_back(x - 440);
    }
    return columns;
  };
  const std::vector<int> now = left_boundary(8);
  const auto [min_retreat, max_retreat] = std::minmax_element(now.begin(), now.end());
  EXPECT_GE(*max_retreat - *min_retreat, 3);
  EXPECT_LE(*max_retreat, 8);
  const auto change = [&](int index) {
    const std::vector<int> other = left_boundary(index);
    double sum = 0.0;
    for (std::size_t i = 0; i < now.size(); ++i) sum += std::abs(other[i] - now[i]);
    return sum / static_cast<double>(now.size());
  };
  EXPECT_LT(change(9), 0.6 * change(28));
}

TEST(MaskErrors, ThinObjectsDoNotVanish) {
  Mask instances(640, 480);
  fill(instances, 100, 100, 8, 30, 1);
  MaskErrorConfig config = none();
  config.erosion = 6.0;
  for (int index = 0; index < 50; ++index) {
    EXPECT_GT(count(imperfect_masks(instances, kClasses, config, 1, index), 1), 8 * 30 / 4);
  }
}

TEST(MaskErrors, ErosionIgnoresImageBorder) {
  Mask instances(640, 480);
  fill(instances, 0, 100, 100, 200, 1);
  MaskErrorConfig config = none();
  config.erosion = 3.0;
  const Mask labels = imperfect_masks(instances, kClasses, config, 1, 0);
  EXPECT_EQ(labels(0, 200), 1);
  EXPECT_EQ(labels(0, 101), 0);
  EXPECT_EQ(labels(99, 200), 0);
}

TEST(MaskErrors, LosePartsInConfiguredShareOfFrames) {
  MaskErrorConfig config = none();
  config.lost_parts = 0.3;
  const Mask instances = scene(128);
  const double whole = count(instances, 2);
  int lost = 0;
  for (int index = 0; index < 2000; ++index) {
    const Mask labels = imperfect_masks(instances, kClasses, config, 2, index);
    const double share = count(labels, 2) / whole;
    if (share == 1.0) continue;
    ++lost;
    EXPECT_GT(share, 0.4);
    EXPECT_LT(share, 0.98);
  }
  EXPECT_NEAR(lost / 2000.0, 0.3, 0.03);
}

TEST(MaskErrors, SpillOnlyOverBackground) {
  MaskErrorConfig config = none();
  config.spill = 0.3;
  config.erosion = config.boundary_jitter = 2.0;
  const Mask instances = scene(320);
  const Mask truth = exact(instances);
  int spilled = 0;
  for (int index = 0; index < 300; ++index) {
    const Mask labels = imperfect_masks(instances, kClasses, config, 2, index);
    int beyond = 0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (truth[i] != 0) {
        ASSERT_TRUE(labels[i] == 0 || labels[i] == truth[i]);
      }
      if (truth[i] == 0 && labels[i] == 2) ++beyond;
    }
    if (beyond > 0) ++spilled;
    EXPECT_LT(beyond, 8 * (80 + 100));
  }
  EXPECT_NEAR(spilled / 300.0, 0.3, 0.06);
}

TEST(MaskErrors, AreDeterministicPerSeedAndFrame) {
  MaskErrorConfig config;
  config.enabled = true;
  Mask after;
  int changes = 0;
  for (int index = 29; index >= 0; --index) {
    const Mask labels = imperfect_masks(scene(), kClasses, config, 5, index);
    EXPECT_EQ(labels.pixels(), imperfect_masks(scene(), kClasses, config, 5, index).pixels());
    changes += labels.pixels() != after.pixels() ? 1 : 0;
    after = labels;
  }
  EXPECT_GT(changes, 25);
  EXPECT_NE(imperfect_masks(scene(), kClasses, config, 5, 3).pixels(),
            imperfect_masks(scene(), kClasses, config, 6, 3).pixels());
}

/// Collects the keys and checks that the defaults are in range.
class KeyVisitor : public ConfigVisitor {
 public:
  std::vector<std::string> keys;

  void number(const FieldInfo& info, double& value, Range range) override {
    keys.emplace_back(info.key);
    EXPECT_FALSE(info.doc.empty());
    EXPECT_GE(value, range.min);
    EXPECT_LE(value, range.max);
  }
  void integer(const FieldInfo& info, int&, Range) override { keys.emplace_back(info.key); }
  void boolean(const FieldInfo& info, bool&) override { keys.emplace_back(info.key); }
  void choice(const FieldInfo& info, int&, std::span<const std::string_view>) override {
    keys.emplace_back(info.key);
  }
  void text(const FieldInfo& info, std::string&) override { keys.emplace_back(info.key); }

 protected:
  void begin_group(const FieldInfo&) override {}
  void end_group() override {}
};

TEST(MaskErrors, DeclareAllFields) {
  KeyVisitor visitor;
  MaskErrorConfig config;
  config.visit(visitor);
  EXPECT_EQ(visitor.keys, (std::vector<std::string>{"enabled", "missed", "spell", "erosion",
                                                    "boundary_jitter", "lost_parts", "spill"}));
}

}  // namespace
}  // namespace mms
