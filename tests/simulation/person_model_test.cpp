#include "mms/simulation/people/person_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/simulation/people/person_proportions.hpp"

namespace mms {
namespace {

using Part = PersonPart;

PersonStyle style_of(float height) {
  PersonStyle style;
  style.height = height;
  return style;
}

Activity walking(double travelled, double speed) {
  return {.seconds = travelled / std::max(speed, 0.1), .travelled = travelled, .speed = speed};
}

/// Bounds of parts [first, last) in the object frame.
Eigen::AlignedBox3f bounds_of(const ArticulatedModel& person, const Activity& activity,
                              std::size_t first, std::size_t last) {
  const std::vector<Eigen::Isometry3f> poses = person.pose(activity);
  Eigen::AlignedBox3f box;
  for (std::size_t i = first; i < last; ++i) box.extend(bounds(person.parts()[i], poses[i]));
  return box;
}

float lowest(const ArticulatedModel& person, const Activity& activity, std::size_t part) {
  return bounds_of(person, activity, part, part + 1).min().z();
}

/// Largest motion of any corner of the bounds of any part between two instants.
float motion(const ArticulatedModel& person, const Activity& a, const Activity& b) {
  const std::vector<Eigen::Isometry3f> before = person.pose(a);
  const std::vector<Eigen::Isometry3f> after = person.pose(b);
  float max_motion = 0.0F;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Eigen::AlignedBox3f box = bounds(person.parts()[i], Eigen::Isometry3f::Identity());
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3f p = box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(corner));
      max_motion = std::max(max_motion, (after[i] * p - before[i] * p).norm());
    }
  }
  return max_motion;
}

TEST(PersonModel, HasHeightOfStyle) {
  for (const float height : {1.5F, 1.62F, 1.75F, 1.95F}) {
    PersonStyle style = style_of(height);
    for (const Headwear headwear : {Headwear::kHair, Headwear::kHardHat}) {
      style.headwear = headwear;
      const auto person = make_person(style);
      const float top = bounds_of(*person, {}, 0, person->parts().size()).max().z();
      const bool hat = headwear == Headwear::kHardHat;
      EXPECT_NEAR(top, height * (hat ? 1.02F : 1.0F), 0.02F * height);
    }
  }
}

TEST(PersonModel, LowerFootTouchesFloorDuringGait) {
  for (const float height : {1.52F, 1.75F, 1.93F}) {
    const auto person = make_person(style_of(height));
    for (const double speed : {0.0, 0.1, 0.3, 0.8, 1.4}) {
      for (double travelled = 0.0; travelled < 1.6; travelled += 0.02) {
        const Activity activity = walking(travelled, speed);
        const float left = lowest(*person, activity, Part::kLeftShoe);
        const float right = lowest(*person, activity, Part::kRightShoe);
        EXPECT_NEAR(std::min(left, right), 0.0F, 0.004F) << speed << ' ' << travelled;
        EXPECT_GT(bounds_of(*person, activity, 0, person->parts().size()).min().z(), -0.01F);
      }
    }
  }
}

TEST(PersonModel, SupportingFootStaysInPlace) {
  const PersonStyle style = style_of(1.75F);
  const auto person = make_person(style);
  const double stride = 1.5 * static_cast<double>(PersonProportions(1.75F, 1.0F).leg());
  const auto heel = [&](double travelled) {
    const Eigen::Isometry3f T = person->pose(walking(travelled, 1.3))[Part::kLeftShoe];
    return static_cast<double>(T.translation().x()) + travelled;
  };
  for (double share = 0.12; share < 0.33; share += 0.02) {
    EXPECT_NEAR(heel(share * stride), heel(0.12 * stride), 0.003);
  }
}

TEST(PersonModel, MovesContinuously) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    PersonStyle style = random_person_style(seed);
    style.working = seed % 2 == 0;
    style.carries_box = seed % 3 == 0;
    const auto person = make_person(style);
    for (double t = 0.0; t < 12.0; t += 0.01) {
      const double speed = std::clamp(0.25 * (t - 3.0), 0.0, 1.5);
      const Activity now{.seconds = t, .travelled = 0.7 * t, .speed = speed};
      const Activity next{
          .seconds = t + 1e-3, .travelled = 0.7 * t + 0.7e-3, .speed = speed + 1e-4};
      EXPECT_LT(motion(*person, now, next), 0.006F) << seed << " at " << t;
    }
  }
}

TEST(PersonModel, StandingPersonMovesLittle) {
  const auto person = make_person(style_of(1.8F));
  for (double t = 0.1; t < 20.0; t += 0.5) {
    const float moved = motion(*person, {.seconds = 0.0}, {.seconds = t});
    EXPECT_LT(moved, 0.10F);
    EXPECT_GT(moved, 1e-4F);
  }
}

void expect_joined(const std::vector<Eigen::Isometry3f>& poses, std::size_t upper,
                   std::size_t lower, float length) {
  const Eigen::Vector3f end = poses[upper] * Eigen::Vector3f(0.0F, 0.0F, -length);
  EXPECT_LT((end - poses[lower].translation()).norm(), 1e-3F) << upper;
}

TEST(PersonModel, JointsStayConnected) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const PersonStyle style = random_person_style(seed);
    const PersonProportions body(style.height, style.build);
    const auto person = make_person(style);
    for (double t = 0.0; t < 10.0; t += 0.1) {
      const auto poses =
          person->pose({.seconds = t, .travelled = t, .speed = seed % 2 ? 1.2 : 0.0});
      for (std::size_t i = 0; i < 2; ++i) {
        expect_joined(poses, Part::kLeftUpperArm + i, Part::kLeftForearm + i, body.upper_arm);
        expect_joined(poses, Part::kLeftThigh + i, Part::kLeftShank + i, body.thigh);
        expect_joined(poses, Part::kLeftShank + i, Part::kLeftShoe + i, body.shank);
        const Eigen::Vector3f hip(0.0F, (i == 0 ? 1.0F : -1.0F) * body.hip_y, 0.0F);
        EXPECT_LT((poses[Part::kPelvis] * hip - poses[Part::kLeftThigh + i].translation()).norm(),
                  1e-4F);
      }
    }
  }
}

TEST(PersonModel, StepLengthFollowsLegsAndKneesBend) {
  const auto person = make_person(style_of(1.75F));
  const PersonProportions body(1.75F, 1.0F);
  float ahead = 0.0F;
  float most_bent = 1.0F;
  for (double travelled = 0.0; travelled < 2.0; travelled += 0.01) {
    const auto poses = person->pose(walking(travelled, 1.3));
    ahead = std::max(
        ahead, (poses[Part::kLeftShoe].translation() - poses[Part::kRightShoe].translation()).x());
    most_bent = std::min(most_bent, poses[Part::kLeftThigh].linear().col(2).dot(
                                        poses[Part::kLeftShank].linear().col(2)));
  }
  EXPECT_NEAR(ahead, 0.75F * body.leg(), 0.12F * body.leg());
  EXPECT_LT(most_bent, std::cos(0.8F));
}

TEST(PersonModel, WorkerReachesUpAndDown) {
  PersonStyle style = style_of(1.75F);
  style.working = true;
  const auto person = make_person(style);
  float low = 9.0F;
  float high = 0.0F;
  for (double t = 0.0; t < 20.0; t += 0.1) {
    const float z =
        bounds_of(*person, {.seconds = t}, Part::kLeftForearm, Part::kLeftThigh).max().z();
    low = std::min(low, z);
    high = std::max(high, z);
  }
  EXPECT_GT(high - low, 0.4F);
}

TEST(PersonModel, HandsHoldBox) {
  PersonStyle style = style_of(1.75F);
  style.carries_box = true;
  const auto person = make_person(style);
  const auto poses = person->pose(walking(0.4, 1.2));
  const Eigen::AlignedBox3f box =
      bounds(person->parts()[Part::kCarriedBox], Eigen::Isometry3f::Identity());
  for (std::size_t i = 0; i < 2; ++i) {
    const Eigen::Vector3f palm =
        poses[Part::kCarriedBox].inverse() *
        (poses[Part::kLeftForearm + i] * Eigen::Vector3f(0.0F, 0.0F, -0.31F));
    EXPECT_LT(box.exteriorDistance(palm), 0.06F);
  }
}

TEST(PersonModel, SeedDeterminesPerson) {
  const Activity activity = walking(1.1, 1.2);
  const auto a = make_person(random_person_style(7));
  const auto b = make_person(random_person_style(7));
  const auto c = make_person(random_person_style(8));
  ASSERT_EQ(a->parts().size(), b->parts().size());
  for (std::size_t i = 0; i < a->parts().size(); ++i) {
    EXPECT_EQ(a->pose(activity)[i].matrix(), b->pose(activity)[i].matrix());
    EXPECT_EQ(a->parts()[i].vertices.size(), b->parts()[i].vertices.size());
  }
  EXPECT_NE(a->pose(activity)[Part::kHead].matrix(), c->pose(activity)[Part::kHead].matrix());
  EXPECT_EQ(a->object_class(), ObjectClass::kPerson);
  EXPECT_EQ(a->kind(), "person");
}

TEST(PersonModel, RandomStylesAreInRangeAndVaried) {
  int vests = 0;
  int boxes = 0;
  int hats = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const PersonStyle style = random_person_style(seed);
    EXPECT_GE(style.height, 1.5F);
    EXPECT_LE(style.height, 1.95F);
    vests += style.vest ? 1 : 0;
    boxes += style.carries_box ? 1 : 0;
    hats += style.headwear == Headwear::kHardHat ? 1 : 0;
    std::size_t triangles = 0;
    if (seed >= 20) continue;
    const auto person = make_person(style);
    for (const Mesh& part : person->parts()) triangles += part.triangles.size();
    EXPECT_LT(triangles, 8000U);
  }
  for (const int count : {vests, boxes, hats}) {
    EXPECT_GT(count, 20);
    EXPECT_LT(count, 160);
  }
}

TEST(PersonModel, RejectsImpossibleStyle) {
  try {
    make_person(style_of(3.0F));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("height = 3.0"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace mms
