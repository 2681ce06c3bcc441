#include "mms/server/viewer/viewer.hpp"

#include <gtest/gtest.h>

#include "tests/server/decoded_message.hpp"
#include "tests/server/scenes.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests
using namespace std::chrono_literals;
using Clock = Viewer::Clock;

/// A viewer with its own clock and the messages sent to it.
class TestViewer {
 public:
  explicit TestViewer(std::shared_ptr<Scene> scene)
      : scene_(std::move(scene)), viewer_(*scene_, "1") {}

  Viewer& viewer() { return viewer_; }
  void receive(const std::string& text) { viewer_.receive(text, now_); }

  /// Advances the time and does the work of the server's other threads.
  void advance(Clock::duration time) {
    now_ += time;
    viewer_.tick(now_);
    if (const auto wanted = viewer_.requested_pictures(now_)) {
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

  /// The next message, as for a socket that is ready to send.
  std::optional<DecodedMessage> take() {
    const auto encode = viewer_.next(now_);
    if (!encode) return std::nullopt;
    return decode_message(*(*encode)());
  }

  /// All pending messages.
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

TEST(Viewer, SendsAllDataAtStart) {
  TestViewer viewer(finished_scene(10));
  viewer.advance(0ms);
  const auto messages = viewer.drain();
  EXPECT_EQ(types_of(messages), "hello state trajectory series tracks map frame");
  EXPECT_EQ(only(messages, "trajectory").values<std::uint32_t>("stamp").size(), 10U);
  EXPECT_EQ(only(messages, "map").values<float>("points").size(), 3 * 400U);
}

TEST(Viewer, WaitsForFirstFrameOfLiveRun) {
  const auto scene = live_scene();
  TestViewer viewer(scene);
  viewer.advance(1s);
  EXPECT_EQ(types_of(viewer.drain()), "");
  scene->set_sensor(std::nullopt, Eigen::Vector3d::UnitZ());
  scene->add(frame_at(0), nullptr, floor_map(4));
  viewer.advance(1s);
  const auto messages = viewer.drain();
  EXPECT_EQ(only(messages, "hello").json["up"], (nlohmann::json{0.0, 0.0, 1.0}));
  EXPECT_EQ(only(messages, "frame").json["frame"], 0);
}

TEST(Viewer, SlowViewerGetsNewestFrameAndAllPoses) {
  const auto scene = live_scene();
  scene->add(frame_at(0), nullptr, nullptr);
  TestViewer viewer(scene);
  viewer.advance(33ms);
  viewer.drain();
  for (std::size_t i = 1; i < 100; ++i) {  // the socket is not ready meanwhile
    scene->add(frame_at(i), nullptr, nullptr);
    viewer.advance(33ms);
  }
  const auto messages = viewer.drain();
  EXPECT_EQ(types_of(messages), "trajectory series frame");
  EXPECT_EQ(only(messages, "frame").json["frame"], 99);
  EXPECT_EQ(only(messages, "trajectory").json["first_frame"], 1);
  EXPECT_EQ(only(messages, "trajectory").values<std::uint32_t>("stamp").size(), 98U);
  viewer.receive(R"({"type":"speed","value":1})");
  EXPECT_EQ(only(viewer.drain(), "state").json["dropped"], 98);
}

TEST(Viewer, LivePicturesBelongToNewestFrame) {
  const auto scene = live_scene(true);
  scene->add(frame_at(0), view_of(0), nullptr);
  TestViewer viewer(scene);
  viewer.advance(1s);
  const auto first = viewer.drain();
  EXPECT_EQ(only(first, "frame").json["pictures"], "here");
  scene->add(frame_at(1), view_of(1), nullptr);
  scene->add(frame_at(2), view_of(2), nullptr);
  viewer.advance(10ms);
  EXPECT_EQ(types_of(viewer.drain()), "trajectory series") << "at most 15 frames per second";
  viewer.advance(60ms);
  const auto next = viewer.drain();
  EXPECT_EQ(only(next, "frame").json["frame"], 2);
  EXPECT_EQ(only(next, "frame").values<float>("points")[2], 2.0F);
}

TEST(Viewer, PausedViewerDoesNotStopOthers) {
  const auto scene = live_scene();
  scene->add(frame_at(0), nullptr, nullptr);
  TestViewer paused(scene);
  TestViewer other(scene);
  paused.advance(33ms);
  other.advance(33ms);
  paused.drain();
  other.drain();
  paused.receive(R"({"type":"pause"})");
  EXPECT_EQ(only(paused.drain(), "state").json["playing"], false);
  scene->add(frame_at(1), nullptr, nullptr);
  paused.advance(33ms);
  other.advance(33ms);
  EXPECT_EQ(types_of(paused.drain()), "");
  EXPECT_EQ(only(other.drain(), "frame").json["frame"], 1);
  paused.receive(R"({"type":"play"})");
  paused.advance(33ms);
  EXPECT_EQ(only(paused.drain(), "frame").json["frame"], 1);
}

TEST(Viewer, SeekShowsFrameBeforePictures) {
  SceneInfo info = scene_info(false);
  info.has_pictures = true;
  const auto scene = std::make_shared<Scene>(info);
  scene->set_loader([](std::size_t frame) { return view_of(frame); });
  for (std::size_t i = 0; i < 10; ++i) scene->add(frame_at(i), nullptr, nullptr);
  scene->end("/nowhere");
  TestViewer viewer(scene);
  viewer.advance(0ms);
  viewer.receive(R"({"type":"pause"})");
  viewer.drain();
  viewer.advance(0ms);
  viewer.drain();
  viewer.receive(R"({"type":"seek","frame":6})");
  viewer.viewer().tick(Clock::time_point(33ms));
  const auto bare = viewer.drain();
  EXPECT_EQ(only(bare, "frame").json["frame"], 6);
  EXPECT_EQ(only(bare, "frame").json["pictures"], "pending");
  viewer.advance(33ms);
  const auto whole = viewer.drain();
  EXPECT_EQ(only(whole, "frame").json["pictures"], "here");
  EXPECT_TRUE(only(whole, "frame").buffers.contains("image"));
  viewer.advance(33ms);
  EXPECT_EQ(types_of(viewer.drain()), "");
  viewer.receive(R"({"type":"want","image":false,"points":true})");
  viewer.advance(33ms);
  EXPECT_FALSE(only(viewer.drain(), "frame").buffers.contains("image"));
}

TEST(Viewer, SeekBeyondRunShowsLastFrame) {
  TestViewer viewer(finished_scene(5));
  viewer.advance(0ms);
  viewer.drain();
  viewer.receive(R"({"type":"pause"})");
  for (const char* command : {R"({"type":"seek","frame":1000000000})", R"({"type":"step"})"}) {
    viewer.receive(command);
    viewer.receive(R"({"type":"want","image":false})");
    for (const DecodedMessage& message : viewer.drain()) {  // without a preceding tick
      if (message.type() == "frame") {
        EXPECT_EQ(message.json["frame"], 4);
      }
    }
  }
}

TEST(Viewer, AcceptsSeekBeforeFirstFrame) {
  const auto scene = live_scene();
  TestViewer viewer(scene);
  viewer.receive(R"({"type":"seek","frame":3})");
  scene->add(frame_at(0), nullptr, nullptr);
  EXPECT_EQ(only(viewer.drain(), "frame").json["frame"], 0);
}

TEST(Viewer, LimitsNumberOfErrorMessages) {
  TestViewer viewer(finished_scene(3));
  viewer.advance(0ms);
  viewer.drain();
  for (int i = 0; i < 1000; ++i) EXPECT_FALSE(viewer.viewer().receive("garbage", {}));
  EXPECT_LE(viewer.drain().size(), 8U);
  EXPECT_TRUE(viewer.viewer().receive(R"({"type":"play"})", {}));
}

TEST(Viewer, ReportsEndOfLiveRun) {
  const auto scene = live_scene();
  scene->add(frame_at(0), nullptr, nullptr);
  scene->add(frame_at(1), nullptr, nullptr);
  TestViewer viewer(scene);
  viewer.advance(33ms);
  viewer.drain();
  scene->change([](std::size_t index, SceneFrame& frame) {
    frame.truth.reset();
    if (index == 0) frame.truth = Eigen::Vector3d(5.0, 0.0, 0.0);
  });
  scene->end("/nowhere");
  viewer.advance(33ms);
  const auto messages = viewer.drain();
  EXPECT_EQ(only(messages, "trajectory").json["first_frame"], 0);
  EXPECT_EQ(only(messages, "trajectory").values<float>("truth")[0], 5.0F);
  EXPECT_EQ(only(messages, "state").json["ended"], true);
  viewer.receive(R"({"type":"play"})");
  viewer.advance(10ms);
  EXPECT_EQ(only(viewer.drain(), "frame").json["frame"], 0) << "it plays again";
}

TEST(Viewer, ShowsCorrectedFramesAndLoopsInALiveRun) {
  const auto scene = live_scene();
  scene->add(frame_at(0), nullptr, floor_map(20));
  scene->add(frame_at(1), nullptr, nullptr);
  TestViewer viewer(scene);
  viewer.advance(33ms);
  viewer.drain();
  const ColoredPoints map = floor_points(10);
  scene->set_loops({{0, 1, true, "accepted"}});
  const auto later_frame = [](std::size_t index, SceneFrame& frame) {
    frame = frame_at(index + 3);
  };
  scene->change(later_frame,
                std::make_shared<const MapChanges>(changes_of(map.points, map.colors, 0.1)));
  viewer.advance(1s);
  const auto messages = viewer.drain();
  EXPECT_EQ(only(messages, "trajectory").values<float>("pose")[0], 3.0F);
  EXPECT_EQ(only(messages, "map").values<float>("points").size(), 3 * 100U);
  EXPECT_EQ(only(messages, "loops").values<std::uint32_t>("frames"),
            (std::vector<std::uint32_t>{0, 1}));
  scene->add(frame_at(5), nullptr, nullptr);
  viewer.advance(33ms);
  EXPECT_EQ(only(viewer.drain(), "frame").values<float>("pose")[0], 5.0F);
  TestViewer later(scene);
  later.advance(33ms);
  EXPECT_EQ(only(later.drain(), "loops").values<std::uint32_t>("frames").size(), 2U);
}

TEST(Viewer, ShowsCorrectedResultsAndLoopsAtEndOfLiveRun) {
  const auto scene = live_scene();
  scene->add(frame_at(0), nullptr, floor_map(20));
  scene->add(frame_at(1), nullptr, nullptr);
  TestViewer viewer(scene);
  viewer.advance(33ms);
  viewer.drain();
  const ColoredPoints map = floor_points(10);
  const auto later_frame = [](std::size_t index, SceneFrame& frame) {
    frame = frame_at(index + 3);
  };
  scene->change(later_frame,
                std::make_shared<const MapChanges>(changes_of(map.points, map.colors, 0.1)));
  scene->set_loops({{0, 1, true, "accepted"}, {0, 1, false, "few inliers"}});
  scene->end("/nowhere");
  viewer.advance(1s);
  const auto messages = viewer.drain();
  EXPECT_EQ(only(messages, "trajectory").values<float>("pose")[0], 3.0F);
  EXPECT_EQ(only(messages, "frame").values<float>("pose")[0], 4.0F);
  EXPECT_EQ(only(messages, "series").json["first_frame"], 0);
  EXPECT_EQ(only(messages, "map").values<float>("points").size(), 3 * 100U);
  const auto loops = only(messages, "loops");
  EXPECT_EQ(loops.json["outcomes"], (nlohmann::json{"accepted", "few inliers"}));
  EXPECT_EQ(loops.values<std::uint32_t>("frames"), (std::vector<std::uint32_t>{0, 1, 0, 1}));
  EXPECT_EQ(loops.values<std::uint8_t>("accepted"), (std::vector<std::uint8_t>{1, 0}));
  EXPECT_EQ(loops.values<std::uint8_t>("outcome"), (std::vector<std::uint8_t>{0, 1}));
}

TEST(Viewer, LateViewerOfAnEndedLiveRunGetsAFinishedRun) {
  const auto scene = live_scene();
  for (std::size_t i = 0; i < 3; ++i) scene->add(frame_at(i), nullptr, nullptr);
  scene->end("/nowhere");
  TestViewer viewer(scene);
  viewer.advance(33ms);
  const auto messages = viewer.drain();
  EXPECT_EQ(only(messages, "hello").json["live"], false);
  EXPECT_EQ(only(messages, "hello").json["frames"], 3);
}

TEST(Viewer, SendsTheHistoryOfALongRunInParts) {
  constexpr std::size_t kFrames = 10'000;
  const auto scene = live_scene();
  for (std::size_t i = 0; i < kFrames; ++i) scene->add(frame_at(i), nullptr, nullptr);
  TestViewer viewer(scene);
  viewer.advance(33ms);
  const auto messages = viewer.drain();
  const auto rows_of = [&](const std::string& type, const std::string& buffer, std::size_t width) {
    std::size_t rows = 0;
    for (const DecodedMessage& message : messages) {
      if (message.json["type"] != type) continue;
      if (type != "tracks") {
        EXPECT_EQ(message.json["first_frame"], rows);
      }
      const std::size_t part = message.values<float>(buffer).size() / width;
      EXPECT_LE(part, 4096U);
      rows += part;
    }
    return rows;
  };
  EXPECT_EQ(rows_of("trajectory", "pose", 7), kFrames);
  EXPECT_EQ(rows_of("series", "values", 2), kFrames);
  EXPECT_EQ(rows_of("tracks", "center", 3), kFrames) << "an object in each frame";
}

TEST(Viewer, SendsNoChunksWhenMapIsDisabled) {
  TestViewer viewer(finished_scene(3));
  viewer.receive(R"({"type":"want","map":false})");
  viewer.advance(0ms);
  const auto messages = viewer.drain();
  EXPECT_EQ(types_of(messages).find("map"), std::string::npos);
  viewer.receive(R"({"type":"want","map":true})");
  viewer.advance(1ms);
  only(viewer.drain(), "map");
}

TEST(Viewer, APausedLiveRunKeepsThePicturesThatAreShown) {
  const auto scene = live_scene(true);
  scene->add(frame_at(0), view_of(0), nullptr);
  TestViewer viewer(scene);
  viewer.advance(1s);
  viewer.drain();
  scene->add(frame_at(1), view_of(1), nullptr);
  viewer.advance(10ms);  // its pictures are not due yet
  viewer.drain();
  scene->add(frame_at(2), view_of(2), nullptr);
  viewer.receive(R"({"type":"pause"})");
  viewer.advance(33ms);
  const auto messages = viewer.drain();
  EXPECT_EQ(types_of(messages), "state") << "no frame without pictures";
  EXPECT_EQ(only(messages, "state").json["frame"], 0);
}

TEST(Viewer, ARepeatedWantSendsNoPicturesAgain) {
  const auto scene = live_scene(true);
  scene->add(frame_at(0), view_of(0), nullptr);
  TestViewer viewer(scene);
  viewer.advance(1s);
  viewer.drain();
  viewer.receive(R"({"type":"pause"})");
  scene->add(frame_at(1), view_of(1), nullptr);
  viewer.receive(R"({"type":"want","points":true,"image":true})");
  viewer.advance(33ms);
  EXPECT_EQ(types_of(viewer.drain()), "state");
}

}  // namespace
}  // namespace mms
