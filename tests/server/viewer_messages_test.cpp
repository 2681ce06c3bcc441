#include "mms/server/viewer/viewer_messages.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/server/decoded_message.hpp"
#include "tests/server/scenes.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

TEST(Message, AlignsBuffersToFourBytes) {
  MessageWriter writer(nlohmann::json{{"type", "x"}});
  const std::vector<std::uint8_t> bytes = {1, 2, 3, 4, 5};
  const std::vector<float> numbers = {1.5F, -2.0F};
  writer.add("a", bytes, 1);
  writer.add("b", numbers, 2);
  const Message message = writer.finish();
  EXPECT_EQ(message->size() % 4, 0U);
  const DecodedMessage decoded = decode_message(*message);
  EXPECT_EQ(decoded.values<std::uint8_t>("a"), bytes);
  EXPECT_EQ(decoded.values<float>("b"), numbers);
  EXPECT_EQ(decoded.json["buffers"][1]["count"], 1);
}

TEST(Message, ReplacesInvalidUtf8) {
  const Message message = MessageWriter(nlohmann::json{{"type", "x"}, {"name", "a\xff"}}).finish();
  EXPECT_EQ(decode_message(*message).json["name"], "a\xef\xbf\xbd");
}

TEST(Message, HelloDescribesRun) {
  SceneInfo info = scene_info(true);
  info.camera = CameraIntrinsics{500.0, 501.0, 320.0, 240.0, 640, 480, {}};
  const nlohmann::json json = decode_message(*hello_message(info, {"a.ply"}, "1.2")).json;
  EXPECT_EQ(json["protocol"], 1);
  EXPECT_EQ(json["run"], "test-1");
  EXPECT_EQ(json["live"], true);
  EXPECT_EQ(json["frames"], nullptr);
  EXPECT_EQ(json["image"]["fy"], 501.0);
  EXPECT_EQ(json["classes"], (nlohmann::json{"person", "agv", "unknown"}));
  EXPECT_EQ(json["up"], (nlohmann::json{0.0, -1.0, 0.0}));
  EXPECT_EQ(json["files"], nlohmann::json{"a.ply"});
}

TEST(Message, TrajectoryHasPosesStampsAndGroundTruth) {
  const auto scene = finished_scene(5);
  scene->change([](std::size_t index, SceneFrame& frame) {
    if (index == 4) frame.truth.reset();
  });
  const DecodedMessage message = decode_message(*trajectory_message(*scene, 2, 5));
  EXPECT_EQ(message.json["first_frame"], 2);
  const auto poses = message.values<float>("pose");
  ASSERT_EQ(poses.size(), 21U);
  EXPECT_EQ(poses[7], 3.0F);   // x of the second
  EXPECT_EQ(poses[13], 1.0F);  // qw of the second
  EXPECT_EQ(message.values<std::uint32_t>("stamp"), (std::vector<std::uint32_t>{200, 300, 400}));
  const auto truth = message.values<float>("truth");
  EXPECT_EQ(truth[1], 0.25F);
  EXPECT_TRUE(std::isnan(truth[6]));
}

TEST(Message, SeriesHasRowPerFrame) {
  const DecodedMessage message = decode_message(*series_message(*finished_scene(2), 0, 2));
  EXPECT_EQ(message.json["names"], (nlohmann::json{"read", "dynamic_share"}));
  EXPECT_EQ(message.json["units"], (nlohmann::json{"ms", "ratio"}));
  EXPECT_EQ(message.values<float>("values"), (std::vector<float>{0.0F, 0.5F, 1.0F, 0.5F}));
}

TEST(Message, TracksHaveRowPerObjectAndFrame) {
  const DecodedMessage message = decode_message(*tracks_message(*finished_scene(5), 2, 4));
  EXPECT_EQ(message.json["ids"], nlohmann::json{7});
  EXPECT_EQ(message.json["classes"], nlohmann::json{1});
  EXPECT_EQ(message.values<std::uint32_t>("track"), (std::vector<std::uint32_t>{0, 0}));
  EXPECT_EQ(message.values<std::uint32_t>("frame"), (std::vector<std::uint32_t>{2, 3}));
  EXPECT_EQ(message.values<float>("center")[5], 3.0F);
}

TEST(Message, FrameContainsRequestedParts) {
  const EncodedPictures pictures = encode_pictures(*view_of(4));
  const SceneInfo info = scene_info(true);
  SceneFrame frame = frame_at(4);
  frame.series[1] = std::nanf("");
  const DecodedMessage all =
      decode_message(*frame_message(info, frame, 4, PicturesState::kHere, &pictures));
  EXPECT_EQ(all.json["frame"], 4);
  EXPECT_EQ(all.json["stamp_ns"], "400000000");
  EXPECT_EQ(all.json["series"]["read"], 4.0);
  EXPECT_EQ(all.json["series"]["dynamic_share"], nullptr);
  EXPECT_EQ(all.json["objects"][0]["class"], "agv");
  EXPECT_EQ(all.json["objects"][0]["q"], (nlohmann::json{0.0, 0.0, 0.0, 1.0}));
  EXPECT_EQ(all.json["objects"][0]["seen"], true);
  EXPECT_EQ(all.values<float>("points").size(), 21U);
  EXPECT_EQ(all.values<std::uint8_t>("dynamic"), (std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 1}));
  EXPECT_TRUE(all.buffers.at("image").starts_with("\xff\xd8"));
  EXPECT_TRUE(all.buffers.at("mask").starts_with("\x89PNG"));
  const DecodedMessage bare = decode_message(*frame_message(
      info, frame, 4, PicturesState::kHere, &pictures, {.points = false, .image = false}));
  EXPECT_EQ(bare.buffers.size(), 2U);  // pose and truth
  EXPECT_EQ(bare.json["pictures"], "here");
}

TEST(Message, EmptyChunkIsRemoved) {
  const VoxelKey key{-1, 0, 12};
  const DecodedMessage removed = decode_message(*map_message(key, {}));
  EXPECT_EQ(removed.json["chunk"], "-1,0,12");
  EXPECT_EQ(removed.json["remove"], true);
  const DecodedMessage present = decode_message(*map_message(key, {2, 0.4, floor_points(3)}));
  EXPECT_EQ(present.json["remove"], false);
  EXPECT_EQ(present.json["level"], 2);
  EXPECT_EQ(present.values<float>("points").size(), 27U);
  EXPECT_EQ(present.values<std::uint8_t>("colors").size(), 27U);
}

}  // namespace
}  // namespace mms
