#include "mms/ros2/ros2_node.hpp"

#include <dds/dds.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <numeric>
#include <thread>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/ros/display_messages.hpp"
#include "mms/ros/topic_names.hpp"
#include "mms/ros2/ros2_parameters.hpp"

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

/// Calls services as nodes on rmw_cyclonedds_cpp do.
class Client {
 public:
  Client()
      : participant_(dds_create_participant(
            static_cast<dds_domainid_t>(std::atoi(std::getenv("ROS_DOMAIN_ID"))), nullptr,
            nullptr)) {}
  ~Client() { dds_delete(participant_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  /// The reply of the service "/NODE/NAME" of a type as "rcl_interfaces/GetParameters".
  template <class Response, class Request>
  Response call(const std::string& service, const std::string& type, const Request& request) {
    const std::unique_ptr<dds_qos_t, void (*)(dds_qos_t*)> qos(dds_create_qos(), dds_delete_qos);
    dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
    ddsi_sertype* request_type = make_raw_type(msg::dds_type_name(type + "_Request", "srv"));
    ddsi_sertype* reply_type = make_raw_type(msg::dds_type_name(type + "_Response", "srv"));
    const dds_entity_t writer = dds_create_writer(
        participant_, topic("rq" + service + "Request", request_type), qos.get(), nullptr);
    const dds_entity_t reader = dds_create_reader(
        participant_, topic("rr" + service + "Reply", reply_type), qos.get(), nullptr);
    EXPECT_TRUE(becomes_true([&] {
      dds_publication_matched_status_t writing{};
      dds_subscription_matched_status_t reading{};
      dds_get_publication_matched_status(writer, &writing);
      dds_get_subscription_matched_status(reader, &reading);
      return writing.current_count > 0 && reading.current_count > 0;
    }));
    const msg::Numbered<Request> numbered{{7, ++number_}, request};
    const RawSample raw =
        make_raw_sample(request_type, msg::encoded_size(numbered, msg::WireFormat::kCdr));
    msg::encode(numbered, reinterpret_cast<std::uint8_t*>(raw.data), msg::WireFormat::kCdr);
    dds_writecdr(writer, raw.sample);
    ddsi_serdata* sample = nullptr;
    dds_sample_info_t info{};
    EXPECT_TRUE(becomes_true([&] {
      return sample != nullptr || dds_takecdr(reader, &sample, 1, &info, DDS_ANY_STATE) == 1;
    }));
    if (sample == nullptr) return {};
    const auto reply =
        msg::decode<msg::Numbered<Response>>(bytes_of(sample), service, msg::WireFormat::kCdr);
    release(sample);
    dds_delete(writer);
    dds_delete(reader);
    EXPECT_EQ(reply.header.client, 7U);
    EXPECT_EQ(reply.header.number, number_);
    return reply.body;
  }

 private:
  dds_entity_t topic(const std::string& name, ddsi_sertype*& type) const {
    return dds_create_topic_sertype(participant_, name.c_str(), &type, nullptr, nullptr, nullptr);
  }

  dds_entity_t participant_;
  std::int64_t number_ = 0;
};

TEST_F(Ros2NodeTest, SettingsAreParametersThatCanBeRead) {
  Ros2Node node(named("slam"), fail_on_error());
  SystemConfig config;
  config.static_map.voxel_size = 0.07;
  offer_parameters(node, config);
  node.start();
  Client client;
  const std::string place = node.full_name() + "/";

  const auto all = client.call<msg::ListParametersReply>(
      place + "list_parameters", "rcl_interfaces/ListParameters", msg::ListParametersRequest{});
  EXPECT_GT(all.names.size(), 150U);
  EXPECT_EQ(all.names.size(), parameters_of(config).size());
  const auto part = client.call<msg::ListParametersReply>(
      place + "list_parameters", "rcl_interfaces/ListParameters",
      msg::ListParametersRequest{{"occupancy"}, 1});
  EXPECT_NE(std::ranges::find(part.names, "occupancy.voxel_size"), part.names.end());
  EXPECT_EQ(std::ranges::find(part.names, "occupancy.grid.min_height"), part.names.end());
  EXPECT_EQ(part.prefixes, std::vector<std::string>{"occupancy"});

  const msg::ParameterNames names{
      {"static_map.voxel_size", "occupancy.enabled", "fusion.mode", "fusion.stride", "no.such"}};
  const auto values = client.call<msg::ListOf<msg::ParameterValue>>(
      place + "get_parameters", "rcl_interfaces/GetParameters", names);
  ASSERT_EQ(values.items.size(), 5U);
  EXPECT_EQ(values.items[0].double_value, 0.07);
  EXPECT_TRUE(values.items[1].bool_value);
  EXPECT_EQ(values.items[2].string_value, "multimodal");
  EXPECT_EQ(values.items[3].integer_value, config.fusion.stride);
  const auto types = client.call<msg::ListOf<std::uint8_t>>(
      place + "get_parameter_types", "rcl_interfaces/GetParameterTypes", names);
  EXPECT_EQ(types.items, (std::vector<std::uint8_t>{3, 1, 4, 2, 0}));
  const auto descriptors = client.call<msg::ListOf<msg::ParameterDescriptor>>(
      place + "describe_parameters", "rcl_interfaces/DescribeParameters", names);
  ASSERT_EQ(descriptors.items.size(), 5U);
  EXPECT_TRUE(descriptors.items[0].read_only);
  EXPECT_TRUE(descriptors.items[0].description.ends_with("[m]"));
  ASSERT_EQ(descriptors.items[0].floating_point_range.size(), 1U);
  EXPECT_LT(descriptors.items[0].floating_point_range[0].from_value, 0.07);
  EXPECT_EQ(descriptors.items[3].integer_range.size(), 1U);
  EXPECT_NE(descriptors.items[2].additional_constraints.find("vision"), std::string::npos);

  const msg::ListOf<msg::Parameter> change{{{"static_map.voxel_size", values.items[0]}}};
  const auto results = client.call<msg::ListOf<msg::SetParametersResult>>(
      place + "set_parameters", "rcl_interfaces/SetParameters", change);
  ASSERT_EQ(results.items.size(), 1U);
  EXPECT_FALSE(results.items[0].successful);
  EXPECT_NE(results.items[0].reason.find("--set"), std::string::npos);
  const auto result = client.call<msg::SetParametersResult>(
      place + "set_parameters_atomically", "rcl_interfaces/SetParametersAtomically", change);
  EXPECT_FALSE(result.successful);
}

TEST_F(Ros2NodeTest, DoesNotLeaveThisMachineWhereNoNumberIsFree) {
  constexpr int kDomain = 101;  // of no other test
  setenv("ROS_DOMAIN_ID", std::to_string(kDomain).c_str(), 1);
  std::vector<int> sockets;
  const auto occupy = [&](int first, int end) {  // numbers of participants
    for (int i = first; i < end; ++i) {
      sockets.push_back(::socket(AF_INET, SOCK_DGRAM, 0));
      sockaddr_in address{};
      address.sin_family = AF_INET;
      address.sin_port = htons(static_cast<std::uint16_t>(7400 + 250 * kDomain + 10 + 2 * i));
      ::bind(sockets.back(), reinterpret_cast<sockaddr*>(&address), sizeof address);
    }
  };
  occupy(0, 12);
  EXPECT_NO_THROW(Ros2Node(named("a"), fail_on_error()));
  occupy(12, 100);
  EXPECT_THROW(Ros2Node(named("b"), fail_on_error()), Error);
  for (const int socket : sockets) ::close(socket);
}

TEST_F(Ros2NodeTest, RejectsWrongSettings) {
  EXPECT_THROW(Ros2Node(named("a b"), fail_on_error()), ConfigError);
  Ros2NodeOptions options;
  options.distro = "lyrical";
  EXPECT_NO_THROW(Ros2Node(options, fail_on_error()));
  options.distro = "noetic";
  EXPECT_THROW(Ros2Node(options, fail_on_error()), ConfigError);
  for (const char* domain : {"233", "-1", "x"}) {
    setenv("ROS_DOMAIN_ID", domain, 1);
    EXPECT_THROW(Ros2Node(Ros2NodeOptions(), fail_on_error()), ConfigError) << domain;
  }
}

}  // namespace
}  // namespace mms
