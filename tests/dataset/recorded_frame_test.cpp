#include "mms/dataset/recorder/recorded_frame.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/dataset/simulated_frames.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

TEST(RecordedFrame, ConvertsDepthToRecordingUnits) {
  Image<float> depth(6, 1);
  depth[0] = 1.2344F;
  depth[1] = 1.2346F;
  depth[2] = 0.0F;
  depth[3] = std::numeric_limits<float>::infinity();
  depth[4] = std::numeric_limits<float>::quiet_NaN();
  depth[5] = 65.6F;  // exceeds 16 bits
  EXPECT_EQ(recorded_depth(depth, 1000.0).pixels(),
            (std::vector<std::uint16_t>{1234, 1235, 0, 0, 0, 0}));
}

TEST(RecordedFrame, EqualsWrittenFrame) {
  const SensorPreset sensor = small_sensor();
  const SimulatedFrame simulated = synthetic_frame(3, sensor);
  const Frame frame = as_recorded(simulated, {}, sensor);
  EXPECT_EQ(frame.name, "0.300000001");
  EXPECT_EQ(frame.stamp, simulated.frame.stamp);
  EXPECT_EQ(frame.calibration->depth_scale, 1000.0);
  EXPECT_FLOAT_EQ(frame.depth(0, 1), 1.01F);
  EXPECT_NEAR(frame.color(3, 3).r, 200, 3);
  EXPECT_EQ(frame.mask.pixels(), simulated.frame.mask.pixels());
}

TEST(RecordedFrame, NumbersLidarFrames) {
  const SensorPreset sensor = small_sensor(true);
  EXPECT_EQ(as_recorded(synthetic_frame(12, sensor), {}, sensor).name, "000012");
}

TEST(RecordedFrame, AppliesMaskErrors) {
  const SensorPreset sensor = small_sensor();
  SceneConfig config;
  config.mask_errors.enabled = true;
  config.mask_errors.missed = 1.0;
  const SimulatedFrame simulated = synthetic_frame(3, sensor);
  const Image<std::uint8_t> mask = recorded_mask(simulated, config);
  ASSERT_TRUE(mask.same_size(simulated.frame.mask));
  EXPECT_NE(mask.pixels(), simulated.frame.mask.pixels());
}

}  // namespace
}  // namespace mms
