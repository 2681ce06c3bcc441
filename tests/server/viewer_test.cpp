#include "mms/server/viewer/viewer.hpp"

#include <gtest/gtest.h>

#include "tests/server/decoded_message.hpp"
#include "tests/server/scenes.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests
using namespace std::chrono_literals;
using Clock = Viewer::Clock;

/// A viewer with a clock of its own, and what it was sent.
class Desk {
 public:
  explicit Desk(std::shared_ptr<Scene> scene) : scene_(std::move(scene)), viewer_(*scene_, "1") {}

  Viewer& viewer() { return viewer_; }
  void say(const std::string& text) { viewer_.receive(text, now_); }

  /// Lets time pass, and does what the server's other threads would do.
  void pass(Clock::duration time) {
    now_ += time;
    viewer_.tick(now_);
    if (const auto wanted = viewer_.wanted_pictures(now_)) {
      const auto view = scene_->view(*wanted);
      viewer_.loaded(view ? std::make_shared<EncodedPictures>(encode_pictures(*view)) : nullptr);
    }
    if (const auto known = viewer_.wants_plan(now_)) {
      std::optional<std::vector<ChunkState>> chunks;
      const std::uint64_t version = scene_->read_map([&](const MapChunks& map) {
        if (map.version() != *known) chunks = map.states();
        return map.version();
      });
      viewer_.plan_map(chunks, version, now_);
    }
  }

  /// One message, as a socket takes it that has room.
  std::optional<DecodedMessage> take() {
    const auto encode = viewer_.next(now_);
    if (!encode) return std::nullopt;
    return decode_message(*(*encode)());
  }

  /// All there is.
  std::vector<DecodedMessage> drain() {
    std::vector<DecodedMessage> messages;
    while (auto message = take()) messages.push_back(std::move(*message));
    return messages;
  }

 private:
  std::shared_ptr<Scene> scene_;
  Viewer viewer_;
  Clock::time_point now_{};
};

std::string types_of(const std::vector<DecodedMessage>& messages) {
  std::string types;
  for (const DecodedMessage& message : messages) {
    types += (types.empty() ? "" : " ") + message.type();
  }
  return types;
}

const DecodedMessage& only(const std::vector<DecodedMessage>& messages, const std::string& type) {
  const DecodedMessage* found = nullptr;
  for (const DecodedMessage& message : messages) {
    if (message.type() != type) continue;
    EXPECT_EQ(found, nullptr) << "two of " << type;
    found = &message;
  }
  if (found == nullptr) throw std::runtime_error("no " + type + " in " + types_of(messages));
  return *found;
}

std::shared_ptr<Scene> live_scene(bool pictures = false) {
  SceneInfo info = scene_info(true);
  info.has_pictures = pictures;
  return std::make_shared<Scene>(info);
}

TEST(Viewer, GreetsWithAllThereIs) {
  Desk desk(finished_scene(10));
  desk.pass(0ms);
  const auto messages = desk.drain();
  EXPECT_EQ(types_of(messages), "hello state trajectory series tracks map frame");
  EXPECT_EQ(only(messages, "trajectory").values<std::uint32_t>("stamp").size(), 10U);
  EXPECT_EQ(only(messages, "map").values<float>("points").size(), 3 * 400U);
}

TEST(Viewer, WaitsForTheFirstFrameOfALiveRun) {
  const auto scene = live_scene();
  Desk desk(scene);
  desk.pass(1s);
  EXPECT_EQ(types_of(desk.drain()), "");
  scene->set_sensor(std::nullopt, Eigen::Vector3d::UnitZ());
  scene->add(frame_at(0), nullptr, floor_map(4));
  desk.pass(1s);
  const auto messages = desk.drain();
  EXPECT_EQ(only(messages, "hello").json["up"], (nlohmann::json{0.0, 0.0, 1.0}));
  EXPECT_EQ(only(messages, "frame").json["frame"], 0);
}

TEST(Viewer, ASlowOneIsSentTheNewestFrameAndAllPoses) {
  const auto scene = live_scene();
  scene->add(frame_at(0), nullptr, nullptr);
  Desk desk(scene);
  desk.pass(33ms);
  desk.drain();
  for (std::size_t i = 1; i < 100; ++i) {  // its socket takes nothing meanwhile
    scene->add(frame_at(i), nullptr, nullptr);
    desk.pass(33ms);
  }
  const auto messages = desk.drain();
  EXPECT_EQ(types_of(messages), "trajectory series frame");
  EXPECT_EQ(only(messages, "frame").json["frame"], 99);
  EXPECT_EQ(only(messages, "trajectory").json["first_frame"], 1);
  EXPECT_EQ(only(messages, "trajectory").values<std::uint32_t>("stamp").size(), 98U);
  desk.say(R"({"type":"speed","value":1})");
  EXPECT_EQ(only(desk.drain(), "state").json["dropped"], 98);
}

TEST(Viewer, PicturesOfALiveRunAreThoseOfTheNewestFrame) {
  const auto scene = live_scene(true);
  scene->add(frame_at(0), view_of(0), nullptr);
  Desk desk(scene);
  desk.pass(1s);
  const auto first = desk.drain();
  EXPECT_EQ(only(first, "frame").json["pictures"], "here");
  scene->add(frame_at(1), view_of(1), nullptr);
  scene->add(frame_at(2), view_of(2), nullptr);
  desk.pass(10ms);
  EXPECT_EQ(types_of(desk.drain()), "trajectory series") << "frames come at most 15 times a second";
  desk.pass(60ms);
  const auto next = desk.drain();
  EXPECT_EQ(only(next, "frame").json["frame"], 2);
  EXPECT_EQ(only(next, "frame").values<float>("points")[2], 2.0F);
}

TEST(Viewer, APausedOneStandsWhileOthersGoOn) {
  const auto scene = live_scene();
  scene->add(frame_at(0), nullptr, nullptr);
  Desk paused(scene);
  Desk other(scene);
  paused.pass(33ms);
  other.pass(33ms);
  paused.drain();
  other.drain();
  paused.say(R"({"type":"pause"})");
  EXPECT_EQ(only(paused.drain(), "state").json["playing"], false);
  scene->add(frame_at(1), nullptr, nullptr);
  paused.pass(33ms);
  other.pass(33ms);
  EXPECT_EQ(types_of(paused.drain()), "");
  EXPECT_EQ(only(other.drain(), "frame").json["frame"], 1);
  paused.say(R"({"type":"play"})");
  paused.pass(33ms);
  EXPECT_EQ(only(paused.drain(), "frame").json["frame"], 1);
}

TEST(Viewer, ASeekShowsTheFrameAtOnceAndItsPicturesLater) {
  SceneInfo info = scene_info(false);
  info.has_pictures = true;
  const auto scene = std::make_shared<Scene>(info);
  scene->set_loader([](std::size_t frame) { return view_of(frame); });
  for (std::size_t i = 0; i < 10; ++i) scene->add(frame_at(i), nullptr, nullptr);
  scene->end("/nowhere");
  Desk desk(scene);
  desk.pass(0ms);
  desk.say(R"({"type":"pause"})");
  desk.drain();
  desk.pass(0ms);
  desk.drain();
  desk.say(R"({"type":"seek","frame":6})");
  desk.viewer().tick(Clock::time_point(33ms));
  const auto bare = desk.drain();
  EXPECT_EQ(only(bare, "frame").json["frame"], 6);
  EXPECT_EQ(only(bare, "frame").json["pictures"], "pending");
  desk.pass(33ms);
  const auto whole = desk.drain();
  EXPECT_EQ(only(whole, "frame").json["pictures"], "here");
  EXPECT_TRUE(only(whole, "frame").buffers.contains("image"));
  desk.pass(33ms);
  EXPECT_EQ(types_of(desk.drain()), "");
  desk.say(R"({"type":"want","image":false,"points":true})");
  desk.pass(33ms);
  EXPECT_FALSE(only(desk.drain(), "frame").buffers.contains("image"));
}

TEST(Viewer, ASeekBeyondTheRunEndsAtItsLastFrame) {
  Desk desk(finished_scene(5));
  desk.pass(0ms);
  desk.drain();
  desk.say(R"({"type":"pause"})");
  for (const char* command : {R"({"type":"seek","frame":1000000000})", R"({"type":"step"})"}) {
    desk.say(command);
    desk.say(R"({"type":"want","image":false})");
    for (const DecodedMessage& message : desk.drain()) {  // without a tick before
      if (message.type() == "frame") {
        EXPECT_EQ(message.json["frame"], 4);
      }
    }
  }
}

TEST(Viewer, ASeekBeforeThereIsAFrameIsNoFault) {
  const auto scene = live_scene();
  Desk desk(scene);
  desk.say(R"({"type":"seek","frame":3})");
  scene->add(frame_at(0), nullptr, nullptr);
  EXPECT_EQ(only(desk.drain(), "frame").json["frame"], 0);
}

TEST(Viewer, FaultsAreAnsweredButDoNotPileUp) {
  Desk desk(finished_scene(3));
  desk.pass(0ms);
  desk.drain();
  for (int i = 0; i < 1000; ++i) EXPECT_FALSE(desk.viewer().receive("garbage", {}));
  EXPECT_LE(desk.drain().size(), 8U);
  EXPECT_TRUE(desk.viewer().receive(R"({"type":"play"})", {}));
}

TEST(Viewer, LearnsOfTheEndOfALiveRun) {
  const auto scene = live_scene();
  scene->add(frame_at(0), nullptr, nullptr);
  scene->add(frame_at(1), nullptr, nullptr);
  Desk desk(scene);
  desk.pass(33ms);
  desk.drain();
  scene->replace_truth({Eigen::Vector3d(5.0, 0.0, 0.0), std::nullopt});
  scene->end("/nowhere");
  desk.pass(33ms);
  const auto messages = desk.drain();
  EXPECT_EQ(only(messages, "trajectory").json["first_frame"], 0);
  EXPECT_EQ(only(messages, "trajectory").values<float>("truth")[0], 5.0F);
  EXPECT_EQ(only(messages, "state").json["ended"], true);
  desk.say(R"({"type":"play"})");
  desk.pass(10ms);
  EXPECT_EQ(only(desk.drain(), "frame").json["frame"], 0) << "and plays it again";
}

TEST(Viewer, WithoutTheMapThereAreNoChunks) {
  Desk desk(finished_scene(3));
  desk.say(R"({"type":"want","map":false})");
  desk.pass(0ms);
  const auto messages = desk.drain();
  EXPECT_EQ(types_of(messages).find("map"), std::string::npos);
  desk.say(R"({"type":"want","map":true})");
  desk.pass(1ms);
  only(desk.drain(), "map");
}

}  // namespace
}  // namespace mms
