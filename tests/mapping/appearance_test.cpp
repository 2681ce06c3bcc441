#include "mms/mapping/tracking/appearance.hpp"

#include <gtest/gtest.h>

namespace mms {
namespace {

const Eigen::Vector3f kRed(200, 30, 30);
const Eigen::Vector3f kBlue(30, 30, 200);
const Eigen::Vector3f kGrey(90, 90, 90);
const Eigen::Vector3f kWhite(250, 250, 250);

/// A person of 1.8 m with a point every 2 cm from `lowest` [m] upward.
Appearance person(const Eigen::Vector3f& trousers, const Eigen::Vector3f& shirt,
                  double lowest = 0.0) {
  Appearance body;
  for (double height = lowest; height < 1.8; height += 0.02) {
    body.add(height, height < 0.9 ? trousers : shirt);
  }
  return body;
}

TEST(Appearance, IsZeroForEqualColors) {
  EXPECT_NEAR(person(kGrey, kRed).difference(person(kGrey, kRed)).value(), 0.0, 1e-3);
}

TEST(Appearance, DiffersForColorsAtOtherHeights) {
  EXPECT_GT(person(kRed, kBlue).difference(person(kBlue, kRed)).value(), 0.9);
}

TEST(Appearance, ComparesOnlyCommonHeights) {
  const Appearance occluded = person(kBlue, kRed, 0.95);
  EXPECT_NEAR(occluded.difference(person(kGrey, kRed)).value(), 0.0, 1e-3);
}

TEST(Appearance, ShadeDiffersLessThanHue) {
  const Appearance observed = person(kGrey, kRed);
  const double shade = observed.difference(person(kGrey, 0.7F * kRed)).value();
  const Eigen::Vector3f orange(200, 90, 30);
  EXPECT_LT(shade, observed.difference(person(kGrey, orange)).value());
}

TEST(Appearance, ToleratesBackgroundPoints) {
  const Appearance observed = person(kGrey, kRed);
  Appearance with_background = person(kGrey, kRed);
  for (double height = 0.0; height < 1.8; height += 0.2) with_background.add(height, kWhite);
  EXPECT_LT(observed.difference(with_background).value(), 0.3);
  EXPECT_GT(observed.difference(person(kGrey, kBlue)).value(), 0.6);
}

TEST(Appearance, IsUndefinedWithoutCommonHeights) {
  Appearance feet;
  for (int i = 0; i < 20; ++i) feet.add(0.1, kRed);
  EXPECT_FALSE(feet.difference(person(kGrey, kRed, 0.5)).has_value());
  EXPECT_FALSE(Appearance().difference(feet).has_value());
}

TEST(Appearance, LearnsKnownHeightsSlowlyAndNewOnesImmediately) {
  Appearance known = person(kGrey, kRed, 0.95);
  known.learn(person(kGrey, kBlue), 0.1F);
  EXPECT_LT(known.difference(person(kGrey, kRed)).value(), 0.2);
  for (int i = 0; i < 60; ++i) known.learn(person(kGrey, kBlue), 0.1F);
  EXPECT_LT(known.difference(person(kGrey, kBlue)).value(), 0.03);
}

}  // namespace
}  // namespace mms
