#include "mms/simulation/vehicles/agv_model.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace mms {
namespace {

constexpr std::array<AgvKind, kAgvKindCount> kKinds = {AgvKind::kGrabbing, AgvKind::kForklift,
                                                       AgvKind::kScanning, AgvKind::kPioneer,
                                                       AgvKind::kTransport};

Eigen::AlignedBox3f bounds_of(const ArticulatedModel& agv, const Activity& activity) {
  const std::vector<Eigen::Isometry3f> poses = agv.pose(activity);
  Eigen::AlignedBox3f box;
  for (std::size_t i = 0; i < poses.size(); ++i) box.extend(bounds(agv.parts()[i], poses[i]));
  return box;
}

/// Smallest and largest allowed size: length, width, height [m].
struct Size {
  Eigen::Vector3f low;
  Eigen::Vector3f high;
};

Size size_of(AgvKind kind) {
  switch (kind) {
    case AgvKind::kGrabbing:
      return {{1.1F, 0.7F, 0.9F}, {2.0F, 1.9F, 1.75F}};
    case AgvKind::kForklift:
      return {{2.0F, 0.95F, 1.9F}, {2.9F, 1.2F, 2.4F}};
    case AgvKind::kScanning:
      return {{0.65F, 0.5F, 1.45F}, {0.8F, 0.7F, 1.75F}};
    case AgvKind::kPioneer:
      return {{0.38F, 0.35F, 0.3F}, {0.55F, 0.5F, 0.6F}};
    case AgvKind::kTransport:
      break;
  }
  return {{1.35F, 0.75F, 0.65F}, {1.45F, 0.9F, 1.5F}};
}

TEST(AgvModel, HasSizeOfKindAndStandsOnFloor) {
  for (const AgvKind kind : kKinds) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      const auto agv = make_agv(kind, seed);
      for (double t = 0.0; t < 20.0; t += 2.5) {
        const Eigen::AlignedBox3f box =
            bounds_of(*agv, {.seconds = t, .travelled = t, .speed = 1.0});
        EXPECT_GT(box.min().z(), -0.005F) << agv->kind();
        EXPECT_LT(box.min().z(), 0.005F) << agv->kind();
        const Size size = size_of(kind);
        EXPECT_TRUE((box.sizes().array() > size.low.array()).all())
            << agv->kind() << ' ' << box.sizes().transpose();
        EXPECT_TRUE((box.sizes().array() < size.high.array()).all())
            << agv->kind() << ' ' << box.sizes().transpose();
        EXPECT_LT(std::abs(box.center().x()), 0.45F * box.sizes().x());
      }
    }
  }
}

TEST(AgvModel, KindsHaveNames) {
  const std::array<std::string, kAgvKindCount> names = {"grabbing_agv", "forklift", "scanning_agv",
                                                        "pioneer", "transport_agv"};
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    const auto agv = make_agv(kKinds[i], 3);
    EXPECT_EQ(agv->kind(), names[i]);
    EXPECT_EQ(agv->object_class(), ObjectClass::kAgv);
  }
}

/// Whether a part moves when the vehicle drives: a wheel. Its axle is the origin of the part.
bool rotates_with_distance(const ArticulatedModel& agv, std::size_t part) {
  return !agv.pose({}).at(part).isApprox(agv.pose({.travelled = 0.01}).at(part), 1e-6F);
}

TEST(AgvModel, WheelsRollWithoutSlipping) {
  for (const AgvKind kind : kKinds) {
    const auto agv = make_agv(kind, 5);
    int wheels = 0;
    for (std::size_t part = 0; part < agv->parts().size(); ++part) {
      if (!rotates_with_distance(*agv, part)) continue;
      ++wheels;
      constexpr float kStep = 2e-3F;  // [m]
      const Eigen::Isometry3f before = agv->pose({.travelled = 1.0}).at(part);
      const Eigen::Isometry3f after = agv->pose({.travelled = 1.0 + 2e-3}).at(part);
      const Eigen::Vector3f axle = before.translation();
      const Eigen::Vector3f floor(axle.x(), axle.y(), 0.0F);
      const Eigen::Vector3f moved = after * (before.inverse() * floor);
      EXPECT_LT(std::abs((moved - floor).x() + kStep), 2e-5F) << agv->kind() << ' ' << part;
      EXPECT_NEAR(bounds(agv->parts()[part], before).min().z(), 0.0F, 3e-3F);
    }
    EXPECT_GE(wheels, 3) << agv->kind();
  }
}

TEST(AgvModel, ArmMastHeadAndRollersMoveWithTime) {
  for (const AgvKind kind :
       {AgvKind::kGrabbing, AgvKind::kForklift, AgvKind::kScanning, AgvKind::kTransport}) {
    const auto agv = make_agv(kind, 1);
    const auto before = agv->pose({.seconds = 1.0});
    const auto after = agv->pose({.seconds = 3.3});
    int moved = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      moved += (before[i].matrix() - after[i].matrix()).norm() > 0.02F ? 1 : 0;
    }
    EXPECT_GE(moved, 2) << agv->kind();
  }
}

TEST(AgvModel, ForksLiftAndLower) {
  const auto agv = make_agv(AgvKind::kForklift, 1);
  float max_lift = 0.0F;
  const auto start = agv->pose({});
  for (double t = 0.0; t < 20.0; t += 0.5) {
    const auto now = agv->pose({.seconds = t});
    for (std::size_t i = 0; i < now.size(); ++i) {
      max_lift =
          std::max(max_lift, std::abs(now[i].translation().z() - start[i].translation().z()));
    }
  }
  EXPECT_GT(max_lift, 0.2F);
}

TEST(AgvModel, MovesContinuously) {
  for (const AgvKind kind : kKinds) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      const auto agv = make_agv(kind, seed);
      for (double t = 0.0; t < 15.0; t += 0.02) {
        const auto now = agv->pose({.seconds = t, .travelled = t, .speed = 1.0});
        const auto next = agv->pose({.seconds = t + 1e-3, .travelled = t + 1e-3, .speed = 1.0});
        for (std::size_t i = 0; i < now.size(); ++i) {
          EXPECT_LT((now[i].matrix() - next[i].matrix()).norm(), 0.05F) << agv->kind() << ' ' << i;
        }
      }
    }
  }
}

TEST(AgvModel, SeedDeterminesVehicle) {
  for (const AgvKind kind : kKinds) {
    const auto a = make_agv(kind, 4);
    const auto b = make_agv(kind, 4);
    ASSERT_EQ(a->parts().size(), b->parts().size());
    const Activity activity{.seconds = 2.0, .travelled = 1.0, .speed = 0.5};
    for (std::size_t i = 0; i < a->parts().size(); ++i) {
      EXPECT_EQ(a->pose(activity)[i].matrix(), b->pose(activity)[i].matrix());
      EXPECT_EQ(a->parts()[i].materials.at(0).color, b->parts()[i].materials.at(0).color);
    }
    int different = 0;
    for (std::uint64_t seed = 10; seed < 20; ++seed) {
      const auto c = make_agv(kind, seed);
      for (const Material& material : c->parts()[0].materials) {
        bool found = false;
        for (const Material& other : a->parts()[0].materials) {
          found = found || material.color == other.color;
        }
        different += found ? 0 : 1;
      }
    }
    EXPECT_GE(different, 5) << a->kind();
  }
}

}  // namespace
}  // namespace mms
