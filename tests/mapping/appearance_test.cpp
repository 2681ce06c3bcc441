#include "mms/mapping/tracking/appearance.hpp"

#include <gtest/gtest.h>

namespace mms {
namespace {

const Eigen::Vector3f kRed(200, 30, 30);
const Eigen::Vector3f kBlue(30, 30, 200);
const Eigen::Vector3f kGrey(90, 90, 90);
const Eigen::Vector3f kWhite(250, 250, 250);

/// A body of 1.8 m, a point every 2 cm.
Appearance dressed(const Eigen::Vector3f& trousers, const Eigen::Vector3f& shirt,
                   double lowest = 0.0) {
  Appearance body;
  for (double height = lowest; height < 1.8; height += 0.02) {
    body.add(height, height < 0.9 ? trousers : shirt);
  }
  return body;
}

TEST(Appearance, TheSameDressIsNoDifference) {
  EXPECT_NEAR(dressed(kGrey, kRed).difference(dressed(kGrey, kRed)).value(), 0.0, 1e-3);
}

TEST(Appearance, TheSameColoursInOtherPlacesDiffer) {
  EXPECT_GT(dressed(kRed, kBlue).difference(dressed(kBlue, kRed)).value(), 0.9);
}

TEST(Appearance, IsComparedByWhatBothShow) {
  const Appearance behind_a_shelf = dressed(kBlue, kRed, 0.95);
  EXPECT_NEAR(behind_a_shelf.difference(dressed(kGrey, kRed)).value(), 0.0, 1e-3);
}

TEST(Appearance, ShadeDiffersLessThanHue) {
  const Appearance seen = dressed(kGrey, kRed);
  const double shade = seen.difference(dressed(kGrey, 0.7F * kRed)).value();
  const Eigen::Vector3f orange(200, 90, 30);
  EXPECT_LT(shade, seen.difference(dressed(kGrey, orange)).value());
}

TEST(Appearance, AFewPointsOfWhatIsBehindDifferLessThanAnotherDress) {
  const Appearance seen = dressed(kGrey, kRed);
  Appearance frayed = dressed(kGrey, kRed);
  for (double height = 0.0; height < 1.8; height += 0.2) frayed.add(height, kWhite);
  EXPECT_LT(seen.difference(frayed).value(), 0.3);
  EXPECT_GT(seen.difference(dressed(kGrey, kBlue)).value(), 0.6);
}

TEST(Appearance, NothingInCommonIsNoAnswer) {
  Appearance feet;
  for (int i = 0; i < 20; ++i) feet.add(0.1, kRed);
  EXPECT_FALSE(feet.difference(dressed(kGrey, kRed, 0.5)).has_value());
  EXPECT_FALSE(Appearance().difference(feet).has_value());
}

TEST(Appearance, LearnsSlowlyWhatItKnowsAndAtOnceWhatItDoesNot) {
  Appearance known = dressed(kGrey, kRed, 0.95);
  known.learn(dressed(kGrey, kBlue), 0.1F);
  EXPECT_LT(known.difference(dressed(kGrey, kRed)).value(), 0.2);
  for (int i = 0; i < 60; ++i) known.learn(dressed(kGrey, kBlue), 0.1F);
  EXPECT_LT(known.difference(dressed(kGrey, kBlue)).value(), 0.03);
}

}  // namespace
}  // namespace mms
