#include "mms/dataset/simulated_source.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"

namespace mms {
namespace {

constexpr const char* kSmall = "sim:room?frames=3&width=64&height=48&seed=5";

std::string message_of(const std::string& address) {
  try {
    open_simulated(address);
  } catch (const DataError& error) {
    return error.what();
  }
  return "no error";
}

TEST(SimulatedSource, GivesItsFramesAndTheirTruth) {
  const auto source = open_simulated(kSmall);
  EXPECT_EQ(source->size(), 3U);
  ASSERT_EQ(source->ground_truth().size(), 3U);
  for (int i = 0; i < 3; ++i) {
    const std::optional<Frame> frame = source->next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->index, i);
    EXPECT_EQ(frame->color.width(), 64);
    EXPECT_EQ(frame->mask.height(), 48);
    EXPECT_EQ(frame->stamp, source->ground_truth()[static_cast<std::size_t>(i)].stamp);
  }
  EXPECT_FALSE(source->next());
}

TEST(SimulatedSource, SkipsWithoutRendering) {
  const auto source = open_simulated(kSmall);
  source->skip(2);
  EXPECT_EQ(source->next()->index, 2);
  source->skip(100);
  EXPECT_FALSE(source->next());
}

TEST(SimulatedSource, LeavesMasksOutWhenAsked) {
  SourceOptions options;
  options.load_masks = false;
  EXPECT_TRUE(open_simulated(kSmall, options)->next()->mask.empty());
  options.masks = "/tmp";
  EXPECT_THROW(open_simulated(kSmall, options), DataError);
}

TEST(SimulatedSource, DefaultsNeedNoQuery) {
  EXPECT_TRUE(is_simulated("sim:room"));
  EXPECT_FALSE(is_simulated("room"));
  EXPECT_EQ(open_simulated("sim:room")->size(), 150U);
  EXPECT_EQ(open_simulated("sim:room?moving_objects=false")->size(), 150U);
}

TEST(SimulatedSource, SaysWhatIsWrong) {
  EXPECT_NE(message_of("sim:moon").find("sim:room"), std::string::npos);
  EXPECT_NE(message_of("sim:room?sed=1").find("did you mean 'seed'?"), std::string::npos);
  EXPECT_NE(message_of("sim:room?colour=1").find("known are frames, hz, seed"), std::string::npos);
  EXPECT_NE(message_of("sim:room?frames=0").find("allowed is 1 to"), std::string::npos);
  EXPECT_NE(message_of("sim:room?frames=ten").find("frames is 'ten'"), std::string::npos);
  EXPECT_NE(message_of("sim:room?noise=maybe").find("true and false"), std::string::npos);
  EXPECT_NE(message_of("sim:room?frames").find("key=value"), std::string::npos);
}

}  // namespace
}  // namespace mms
