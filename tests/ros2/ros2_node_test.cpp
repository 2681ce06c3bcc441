#include "mms/ros2/ros2_node.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <mutex>
#include <numeric>
#include <thread>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/ros/display_messages.hpp"

namespace mms {
namespace {

using Reliability = TopicQos::Reliability;

class Ros2NodeTest : public ::testing::Test {
 protected:
  void SetUp() override {
    setenv("ROS_LOCALHOST_ONLY", "1", 1);
    setenv("ROS_DOMAIN_ID", std::to_string(1 + getpid() % 100).c_str(), 1);
  }
};

Ros2NodeOptions named(const std::string& name) {
  Ros2NodeOptions options;
  options.name = name;
  options.name_space = "test" + std::to_string(getpid());  // of parallel tests
  return options;
}

Ros2Node::ErrorHandler fail_on_error() {
  return [](const std::string& message) { ADD_FAILURE() << message; };
}

/// Waits for at most 20 s.
template <class Condition>
bool becomes_true(const Condition& condition) {
  for (int i = 0; i < 1000 && !condition(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return condition();
}

/// Larger than a datagram, so that it is sent in fragments.
msg::Image large_image(std::uint32_t seed) {
  msg::Image image;
  image.header.stamp = Timestamp(1'000'000'000 + seed);
  image.header.frame_id = "camera";
  image.height = 300;
  image.width = 1001;
  image.encoding = "mono8";
  image.step = image.width;
  image.data.resize(static_cast<std::size_t>(image.height) * image.width);
  std::iota(image.data.begin(), image.data.end(), static_cast<std::uint8_t>(seed));
  return image;
}

TEST_F(Ros2NodeTest, LargeMessagesArriveUnchanged) {
  Ros2Node talker(named("talker"), fail_on_error());
  Ros2Node listener(named("listener"), fail_on_error());
  const Ros2Writer writer = talker.advertise<msg::Image>("image", {});
  std::mutex mutex;
  std::vector<msg::Image> received;
  listener.subscribe<msg::Image>("image", {}, [&](const msg::Image& image) {
    const std::scoped_lock lock(mutex);
    received.push_back(image);
  });
  listener.start();
  ASSERT_TRUE(becomes_true([&] { return writer.is_wanted(); }));
  for (std::uint32_t i = 0; i < 5; ++i) writer.publish(large_image(i));
  ASSERT_TRUE(becomes_true([&] {
    const std::scoped_lock lock(mutex);
    return received.size() == 5;
  }));
  listener.stop();
  for (std::uint32_t i = 0; i < 5; ++i) {
    EXPECT_EQ(received[i].header.stamp, large_image(i).header.stamp);
    EXPECT_EQ(received[i].encoding, "mono8");
    EXPECT_EQ(received[i].data, large_image(i).data);
  }
}

// A subscription of fixed reliability would get nothing of one of them, or lose fragments.
TEST_F(Ros2NodeTest, SubscriptionTakesReliabilityOfPublishers) {
  for (const Reliability reliability : {Reliability::kReliable, Reliability::kBestEffort}) {
    Ros2Node talker(named("talker"), fail_on_error());
    Ros2Node listener(named("listener"), fail_on_error());
    std::atomic<int> count = 0;
    listener.subscribe<msg::Path>("path", {Reliability::kAsPublishers, false, 10},
                                  [&](const msg::Path&) { ++count; });
    listener.start();
    const Ros2Writer writer = talker.advertise<msg::Path>("path", {reliability, false, 10});
    EXPECT_TRUE(becomes_true([&] {
      writer.publish(msg::Path());
      return count > 2;
    }));
    listener.stop();
  }
}

TEST_F(Ros2NodeTest, ReliableSubscriptionFollowsPublisherThatIsNot) {
  Ros2Node talker(named("talker"), fail_on_error());
  Ros2Node other(named("other"), fail_on_error());
  Ros2Node listener(named("listener"), fail_on_error());
  std::atomic<int> from_other = 0;
  listener.subscribe<msg::Path>("path", {Reliability::kAsPublishers, false, 10},
                                [&](const msg::Path& path) {
                                  if (path.header.frame_id == "other") ++from_other;
                                });
  listener.start();
  const Ros2Writer reliable = talker.advertise<msg::Path>("path", {});
  ASSERT_TRUE(becomes_true([&] { return reliable.is_wanted(); }));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));  // it has become reliable
  const Ros2Writer best_effort =
      other.advertise<msg::Path>("path", {Reliability::kBestEffort, false, 10});
  msg::Path path;
  path.header.frame_id = "other";
  EXPECT_TRUE(becomes_true([&] {
    best_effort.publish(path);
    return from_other > 2;
  }));
  listener.stop();
}

TEST_F(Ros2NodeTest, LateSubscriberGetsLatestMessage) {
  Ros2Node talker(named("talker"), fail_on_error());
  const Ros2Writer writer =
      talker.advertise<msg::Image>("latched", {Reliability::kReliable, true, 1});
  writer.publish(large_image(1));
  writer.publish(large_image(2));
  Ros2Node listener(named("listener"), fail_on_error());
  std::atomic<std::int64_t> stamp = 0;
  std::atomic<int> count = 0;
  listener.subscribe<msg::Image>("latched", {Reliability::kReliable, true, 1},
                                 [&](const msg::Image& image) {
                                   stamp = image.header.stamp.nanoseconds();
                                   ++count;
                                 });
  listener.start();
  EXPECT_TRUE(becomes_true([&] { return count > 0; }));
  listener.stop();
  EXPECT_EQ(stamp, large_image(2).header.stamp.nanoseconds());
  EXPECT_EQ(count, 1);
}

TEST_F(Ros2NodeTest, DamagedMessagesAreReported) {
  Ros2Node talker(named("talker"), fail_on_error());
  std::atomic<int> faults = 0;
  Ros2Node listener(named("listener"), [&](const std::string& message) {
    EXPECT_NE(message.find("image"), std::string::npos) << message;
    ++faults;
  });
  listener.subscribe<msg::Image>("image", {},
                                 [](const msg::Image&) { throw DataError("image", "is damaged"); });
  listener.start();
  const Ros2Writer writer = talker.advertise<msg::Image>("image", {});
  ASSERT_TRUE(becomes_true([&] { return writer.is_wanted(); }));
  writer.publish(large_image(0));
  EXPECT_TRUE(becomes_true([&] { return faults == 1; }));
  listener.stop();
}

TEST_F(Ros2NodeTest, RejectsWrongSettings) {
  EXPECT_THROW(Ros2Node(named("a b"), fail_on_error()), ConfigError);
  Ros2NodeOptions options;
  options.distro = "noetic";
  EXPECT_THROW(Ros2Node(options, fail_on_error()), ConfigError);
  for (const char* domain : {"233", "-1", "x"}) {
    setenv("ROS_DOMAIN_ID", domain, 1);
    EXPECT_THROW(Ros2Node(Ros2NodeOptions(), fail_on_error()), ConfigError) << domain;
  }
}

}  // namespace
}  // namespace mms
