#include "mms/dataset/simulated/simulated_source.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"

namespace mms {
namespace {

constexpr const char* kSmall = "sim:warehouse_loop?frames=3&width=64&seed=5";

std::string message_of(const std::string& address) {
  try {
    open_simulated(address);
  } catch (const DataError& error) {
    return error.what();
  }
  return "no error";
}

TEST(SimulatedSource, ReturnsFramesAndGroundTruth) {
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

TEST(SimulatedSource, OmitsMasksWhenDisabled) {
  SourceOptions options;
  options.load_masks = false;
  EXPECT_TRUE(open_simulated(kSmall, options)->next()->mask.empty());
  options.masks = "/tmp";
  EXPECT_THROW(open_simulated(kSmall, options), DataError);
}

TEST(SimulatedSource, DefaultsNeedNoQuery) {
  EXPECT_TRUE(is_simulated("sim:static"));
  EXPECT_FALSE(is_simulated("static"));
  EXPECT_EQ(open_simulated("sim:static")->size(), 450U);
  EXPECT_EQ(open_simulated("sim:static?noise=false")->size(), 450U);
}

TEST(SimulatedSource, ErrorsExplainInvalidAddress) {
  EXPECT_NE(message_of("sim:moon").find("sim:warehouse_loop"), std::string::npos);
  EXPECT_NE(message_of("sim:crowd?sed=1").find("did you mean 'seed'?"), std::string::npos);
  EXPECT_NE(message_of("sim:crowd?color=1").find("unknown key 'color' (the nearest of "),
            std::string::npos);
  EXPECT_NE(message_of("sim:crowd?frames=-1").find("allowed: 0 to"), std::string::npos);
  EXPECT_NE(message_of("sim:crowd?frames=ten").find("frames is 'ten'"), std::string::npos);
  EXPECT_NE(message_of("sim:crowd?noise=maybe").find("true, false"), std::string::npos);
  EXPECT_NE(message_of("sim:crowd?frames").find("key=value"), std::string::npos);
}

}  // namespace
}  // namespace mms
