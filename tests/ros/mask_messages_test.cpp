#include "mms/ros/mask_messages.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/ros/wire.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

Segmentation two_objects() {
  Segmentation segmentation{16, 12, {}};
  Instance agv{ObjectClass::kAgv, 0.75F, 3, 2, Image<std::uint8_t>(4, 5, 1)};
  agv.mask(1, 1) = 0;
  segmentation.instances.push_back(agv);
  segmentation.instances.push_back(
      {ObjectClass::kPerson, 0.5F, 0, 0, Image<std::uint8_t>(2, 2, 1)});
  return segmentation;
}

TEST(MaskMessages, RoundTrip) {
  const Segmentation sent = two_objects();
  const Segmentation back = segmentation_of(masks_message({}, sent), 16, 12, "test");
  ASSERT_EQ(back.instances.size(), 2U);
  EXPECT_EQ(back.width, 16);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.instances[i].object_class, sent.instances[i].object_class);
    EXPECT_EQ(back.instances[i].score, sent.instances[i].score);
    EXPECT_EQ(back.instances[i].x, sent.instances[i].x);
    EXPECT_EQ(back.instances[i].y, sent.instances[i].y);
    EXPECT_EQ(back.instances[i].mask.pixels(), sent.instances[i].mask.pixels());
  }
}

TEST(MaskMessages, AreUpsampledToImage) {
  const Segmentation back = segmentation_of(masks_message({}, two_objects()), 32, 24, "test");
  const Instance& agv = back.instances[0];
  EXPECT_EQ(back.width, 32);
  EXPECT_EQ(agv.x, 6);
  EXPECT_EQ(agv.y, 4);
  EXPECT_EQ(agv.mask.width(), 8);
  EXPECT_EQ(agv.mask.height(), 10);
  EXPECT_EQ(agv.mask(2, 3), 0);
  EXPECT_EQ(agv.mask(4, 3), 1);
}

TEST(MaskMessages, RejectDamagedMessages) {
  msg::Masks message = masks_message({}, two_objects());
  message.instances[0].object_class = 9;
  expect_in("unknown class 9",
            message_of<DataError>([&] { segmentation_of(message, 16, 12, "test"); }));
  message = masks_message({}, two_objects());
  message.instances[1].mask = "nonsense";
  EXPECT_THROW(segmentation_of(message, 16, 12, "test"), DataError);
  message.width = 0;
  EXPECT_THROW(segmentation_of(message, 16, 12, "test"), DataError);
}

}  // namespace
}  // namespace mms
