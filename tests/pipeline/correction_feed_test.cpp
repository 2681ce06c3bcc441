// Results of loop closure reach the frames after their keyframes.
#include "mms/pipeline/correction_feed.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>

namespace mms {
namespace {

MapCorrection moved_by(double x) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation().x() = x;
  return {Transform<Global, World>(T)};
}

double x_of(const MapCorrection& correction) {
  return correction.T_global_world->translation().x();
}

TEST(CorrectionFeed, TakesEffectAtAStampIfItWaits) {
  CorrectionFeed feed({});
  for (const double seconds : {1.0, 2.0}) {
    std::promise<MapCorrection> result;
    feed.add(Timestamp::from_seconds(seconds), result.get_future());
    result.set_value(moved_by(seconds));
  }
  EXPECT_FALSE(feed.at(Timestamp::from_seconds(1.4)).T_global_world);
  EXPECT_EQ(x_of(feed.at(Timestamp::from_seconds(1.5))), 1.0);
  EXPECT_EQ(x_of(feed.at(Timestamp::from_seconds(2.4))), 1.0);
  EXPECT_EQ(x_of(feed.at(Timestamp::from_seconds(9.0))), 2.0);
  EXPECT_EQ(x_of(feed.at(Timestamp::from_seconds(10.0))), 2.0);
}

TEST(CorrectionFeed, TakesEffectWhenReadyIfItDoesNotWait) {
  CorrectionFeed feed(moved_by(0.0));
  feed.set_waiting(false);
  std::promise<MapCorrection> first, second;
  feed.add(Timestamp::from_seconds(1.0), first.get_future());
  feed.add(Timestamp::from_seconds(2.0), second.get_future());
  second.set_value(moved_by(2.0));
  EXPECT_EQ(x_of(feed.at(Timestamp::from_seconds(9.0))), 0.0);
  first.set_value(moved_by(1.0));
  EXPECT_EQ(x_of(feed.at(Timestamp::from_seconds(9.0))), 2.0);
}

TEST(CorrectionFeed, ThrowsTheErrorOfTheLoopClosure) {
  CorrectionFeed feed({});
  std::promise<MapCorrection> result;
  feed.add(Timestamp::from_seconds(1.0), result.get_future());
  result.set_exception(std::make_exception_ptr(std::runtime_error("no memory")));
  EXPECT_THROW(feed.at(Timestamp::from_seconds(2.0)), std::runtime_error);
}

}  // namespace
}  // namespace mms
