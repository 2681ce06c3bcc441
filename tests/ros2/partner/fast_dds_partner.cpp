// Another vendor's side of the graph of ROS 2, by Fast DDS on UDP over loopback.
//
// usage: fast_dds_partner [OPTION VALUE]...
//   play FILE       publish the messages of an MCAP file; see `speed`, `skip`, `reliability`
//   speed S         times faster than recorded (1)
//   skip SECONDS    of the recording (0)
//   reliability R   of what is played: reliable or best_effort (reliable)
//   receive FOLDER  write the topics of a node to FOLDER/TOPIC.N.cdr, and what is known of the
//                   graph to FOLDER/graph.txt
//   topics LIST     the topics received, as /odometry=nav_msgs/Odometry,...
//   expect N        end after N messages of the first of them
//   call SERVICE    call it (std_srvs/Trigger, with the header of rmw_cyclonedds_cpp) at the end
//   map FILE        call it as nav2_msgs/LoadMap with this map
//   timeout S       end with status 1 after S seconds (60)
// The domain is ROS_DOMAIN_ID.

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "mms/ros/storage/mcap_file.hpp"
#include "mms/ros/topic_names.hpp"

namespace {

using namespace eprosima::fastdds::dds;
using eprosima::fastrtps::rtps::SerializedPayload_t;
using Clock = std::chrono::steady_clock;
namespace rtps = eprosima::fastrtps::rtps;

constexpr int kBuffer = 4 << 20;  // of sockets [B]

/// Samples are the bytes on the wire, as std::string.
class RawTopicType final : public TopicDataType {
 public:
  explicit RawTopicType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = 1024;  // grows with the samples
    m_isGetKeyDefined = false;
    auto_fill_type_information(false);
    auto_fill_type_object(false);
  }
  bool serialize(void* data, SerializedPayload_t* payload) override {
    const auto& bytes = *static_cast<const std::string*>(data);
    if (payload->max_size < bytes.size()) return false;
    payload->encapsulation = CDR_LE;
    payload->length = static_cast<std::uint32_t>(bytes.size());
    std::memcpy(payload->data, bytes.data(), bytes.size());
    return true;
  }
  bool deserialize(SerializedPayload_t* payload, void* data) override {
    static_cast<std::string*>(data)->assign(reinterpret_cast<const char*>(payload->data),
                                            payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    const auto size = static_cast<std::uint32_t>(static_cast<const std::string*>(data)->size());
    return [size] { return size; };
  }
  void* createData() override { return new std::string(); }
  void deleteData(void* data) override { delete static_cast<std::string*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

std::string text_of(const UserDataQosPolicy& data) {
  return {data.data_vec().begin(), data.data_vec().end()};
}

/// Writes what the other participants say of themselves.
class GraphListener final : public DomainParticipantListener {
 public:
  void open(const std::filesystem::path& file) { stream_.open(file); }
  void on_participant_discovery(DomainParticipant*,
                                rtps::ParticipantDiscoveryInfo&& info) override {
    if (info.status != rtps::ParticipantDiscoveryInfo::DISCOVERED_PARTICIPANT) return;
    say("participant " + text_of(info.info.m_userData));
  }
  void on_publisher_discovery(DomainParticipant*, rtps::WriterDiscoveryInfo&& info) override {
    if (info.status == rtps::WriterDiscoveryInfo::DISCOVERED_WRITER)
      say_endpoint("writer", info.info);
  }
  void on_subscriber_discovery(DomainParticipant*, rtps::ReaderDiscoveryInfo&& info) override {
    if (info.status == rtps::ReaderDiscoveryInfo::DISCOVERED_READER)
      say_endpoint("reader", info.info);
  }

 private:
  template <class Endpoint>
  void say_endpoint(const std::string& kind, Endpoint& endpoint) {
    const auto& qos = endpoint.m_qos;
    std::ostringstream guid;
    const rtps::GUID_t& id = endpoint.guid();
    for (const auto byte : id.guidPrefix.value) guid << std::hex << static_cast<int>(byte) << '.';
    for (const auto byte : id.entityId.value) guid << std::hex << static_cast<int>(byte) << '.';
    say(kind + " " + endpoint.topicName().to_string() + " " + endpoint.typeName().to_string() +
        " " + (qos.m_reliability.kind == RELIABLE_RELIABILITY_QOS ? "reliable" : "best_effort") +
        " " +
        (qos.m_durability.kind == TRANSIENT_LOCAL_DURABILITY_QOS ? "transient_local" : "volatile") +
        " " + guid.str() + " " + text_of(qos.m_userData));
  }
  void say(const std::string& line) {
    const std::scoped_lock lock(mutex_);
    if (stream_.is_open()) stream_ << line << std::endl;
  }

  std::mutex mutex_;
  std::ofstream stream_;
};

class Receiver final : public DataReaderListener {
 public:
  Receiver(std::filesystem::path folder, std::string topic)
      : folder_(std::move(folder)), name_(std::move(topic)) {
    for (char& letter : name_) {
      if (letter == '/') letter = '_';
    }
  }
  void on_data_available(DataReader* reader) override {
    std::string bytes;
    SampleInfo info;
    while (reader->take_next_sample(&bytes, &info) == ReturnCode_t::RETCODE_OK) {
      if (!info.valid_data) continue;
      const auto file = folder_ / (name_ + "." + std::to_string(count_) + ".cdr");
      if (!folder_.empty()) std::ofstream(file, std::ios::binary) << bytes;
      const std::scoped_lock lock(mutex_);
      last_ = bytes;
      ++count_;
    }
  }
  std::size_t count() const { return count_; }
  std::string last() const {
    const std::scoped_lock lock(mutex_);
    return last_;
  }

 private:
  mutable std::mutex mutex_;
  std::string last_;
  std::filesystem::path folder_;
  std::string name_;
  std::atomic<std::size_t> count_ = 0;
};

class Partner {
 public:
  Partner() {
    const char* domain = std::getenv("ROS_DOMAIN_ID");
    DomainParticipantQos qos;
    auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    udp->interfaceWhiteList = {"127.0.0.1"};
    udp->sendBufferSize = udp->receiveBufferSize = kBuffer;
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(udp);
    participant_ = DomainParticipantFactory::get_instance()->create_participant(
        static_cast<std::uint32_t>(domain == nullptr ? 0 : std::atoi(domain)), qos, &graph_,
        StatusMask::none());  // only discovery: data are for the readers' listeners
    if (participant_ == nullptr) throw std::runtime_error("no participant");
    publisher_ = participant_->create_publisher(PUBLISHER_QOS_DEFAULT);
    subscriber_ = participant_->create_subscriber(SUBSCRIBER_QOS_DEFAULT);
  }

  ~Partner() {
    participant_->delete_contained_entities();
    DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  void watch(const std::filesystem::path& file) { graph_.open(file); }

  DataWriter* write_to(const std::string& name, const std::string& type, bool reliable,
                       bool transient_local) {
    DataWriterQos qos;
    qos.reliability().kind = reliable ? RELIABLE_RELIABILITY_QOS : BEST_EFFORT_RELIABILITY_QOS;
    qos.durability().kind =
        transient_local ? TRANSIENT_LOCAL_DURABILITY_QOS : VOLATILE_DURABILITY_QOS;
    qos.history().kind = KEEP_LAST_HISTORY_QOS;
    qos.history().depth = 30;
    qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    qos.publish_mode().kind = SYNCHRONOUS_PUBLISH_MODE;
    DataWriter* writer = publisher_->create_datawriter(topic(name, type), qos);
    if (writer == nullptr) throw std::runtime_error("no writer of " + name);
    return writer;
  }

  DataReader* read_from(const std::string& name, const std::string& type, bool transient_local,
                        DataReaderListener* listener) {
    DataReaderQos qos;
    qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
    qos.durability().kind =
        transient_local ? TRANSIENT_LOCAL_DURABILITY_QOS : VOLATILE_DURABILITY_QOS;
    qos.history().kind = KEEP_LAST_HISTORY_QOS;
    qos.history().depth = 100;
    qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    DataReader* reader = subscriber_->create_datareader(topic(name, type), qos, listener);
    if (reader == nullptr) throw std::runtime_error("no reader of " + name);
    return reader;
  }

 private:
  Topic* topic(const std::string& name, const std::string& type) {
    TypeSupport support(new RawTopicType(type));
    support.register_type(participant_);
    Topic* made = participant_->create_topic(name, type, TOPIC_QOS_DEFAULT);
    if (made == nullptr) throw std::runtime_error("no topic " + name);
    return made;
  }

  GraphListener graph_;
  DomainParticipant* participant_ = nullptr;
  Publisher* publisher_ = nullptr;
  Subscriber* subscriber_ = nullptr;
};

/// Waits until all writers have a subscription that does not change for a while.
void wait_for_match(const std::vector<DataWriter*>& writers, Clock::time_point end) {
  constexpr auto kStable = std::chrono::milliseconds(1500);
  auto since = Clock::now();
  std::vector<int> last;
  while (Clock::now() < end) {
    std::vector<int> now;
    bool all = true;
    for (DataWriter* writer : writers) {
      PublicationMatchedStatus status;
      writer->get_publication_matched_status(status);
      all = all && status.current_count > 0;
      now.push_back(status.total_count);
    }
    if (now != last || !all) since = Clock::now();
    last = now;
    if (Clock::now() - since > kStable) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  throw std::runtime_error("nobody subscribes to what is played");
}

/// @param before  called when all is ready, before the first message
template <class Function>
void play(Partner& partner, std::map<std::string, std::string>& options, Clock::time_point end,
          const Function& before) {
  const double speed = std::atof(options["speed"].c_str());
  const double skip = std::atof(options["skip"].c_str());
  const bool reliable = options["reliability"] == "reliable";
  mms::McapFile file(options["play"], options["play"]);
  std::vector<DataWriter*> writers;
  const std::set<std::string> unused = {"geometry_msgs/PoseStamped"};  // the ground truth
  const bool masks = options["masks"] == "on";
  for (const mms::StoredTopic& topic : file.contents().topics) {
    const bool left_out =
        unused.contains(topic.type) || (!masks && topic.name.find("mask") != std::string::npos);
    writers.push_back(left_out
                          ? nullptr
                          : partner.write_to("rt" + topic.name, mms::msg::dds_type_name(topic.type),
                                             reliable, topic.name == "/tf_static"));
  }
  std::vector<DataWriter*> used;
  for (DataWriter* writer : writers) {
    if (writer != nullptr) used.push_back(writer);
  }
  wait_for_match(used, end);
  before();
  const auto start = Clock::now();
  const mms::Timestamp first = file.contents().messages.front().received;
  std::size_t sent = 0;
  for (const mms::StoredMessage& message : file.contents().messages) {
    DataWriter* writer = writers[message.topic];
    const double at = mms::to_seconds(message.received - first) - skip;
    if (writer == nullptr || at < 0.0) continue;
    std::this_thread::sleep_until(start + std::chrono::duration_cast<Clock::duration>(
                                              std::chrono::duration<double>(at / speed)));
    std::string bytes(file.read(message, options["play"]));
    if (!writer->write(&bytes)) std::fprintf(stderr, "a message could not be written\n");
    ++sent;
  }
  std::printf("played %zu messages\n", sent);
  std::fflush(stdout);
}

template <class Condition>
void wait_until(const Condition& condition, Clock::time_point end, const std::string& what) {
  while (!condition()) {
    if (Clock::now() > end) throw std::runtime_error("timeout: " + what);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

/// A call of a service, with the header of rmw_cyclonedds_cpp: identifier of the client, number.
class Call {
 public:
  /// @param map  of nav2_msgs/LoadMap; empty: std_srvs/Trigger
  Call(Partner& partner, const std::string& service, const std::string& map,
       const std::string& folder, Clock::time_point end)
      : service_(service), loads_map_(!map.empty()), replies_(folder, "reply"), end_(end) {
    const std::string type =
        loads_map_ ? "nav2_msgs::srv::dds_::LoadMap_" : "std_srvs::srv::dds_::Trigger_";
    requests_ = partner.write_to("rq" + service + "Request", type + "Request_", true, false);
    partner.read_from("rr" + service + "Reply", type + "Response_", false, &replies_);
    if (loads_map_) {
      const auto size = static_cast<std::uint32_t>(map.size() + 1);
      request_.resize(20);
      request_.append(reinterpret_cast<const char*>(&size), 4);
      request_.append(map.c_str(), size);
    }
    wait_for_match({requests_}, end);
  }
  void send() { requests_->write(&request_); }
  void print_reply() {
    wait_until([&] { return replies_.count() > 0; }, end_, "no reply of " + service_);
    const std::string reply = replies_.last();
    if (reply.size() < 28 || reply.compare(4, 16, request_, 4, 16) != 0) {
      throw std::runtime_error("the reply has another header than the request");
    }
    if (loads_map_) {
      // Behind an empty grid: its header, the time, size and pose of its map, no cells.
      constexpr std::size_t kResult = 4 + 16 + 16 + 20 + 4 + 56 + 4;
      if (reply.size() <= kResult) throw std::runtime_error("the reply is too short");
      std::printf("reply: result %d\n", static_cast<unsigned char>(reply[kResult]));
      return;
    }
    std::printf("reply: success %d, %s\n", reply[20], reply.c_str() + 28);
  }

 private:
  std::string request_ = std::string(
      "\0\1\0\0"
      "client01"
      "\7\0\0\0\0\0\0\0"
      "\0",
      21);
  std::string service_;
  bool loads_map_;
  Receiver replies_;
  Clock::time_point end_;
  DataWriter* requests_ = nullptr;
};

int run(int argc, char** argv) {
  std::map<std::string, std::string> options = {
      {"speed", "1"}, {"skip", "0"}, {"reliability", "reliable"}, {"timeout", "60"}};
  for (int i = 1; i + 1 < argc; i += 2) options[argv[i]] = argv[i + 1];
  const auto end = Clock::now() + std::chrono::seconds(std::atoi(options["timeout"].c_str()));
  const std::string folder = options["receive"];
  std::vector<std::pair<std::string, std::unique_ptr<Receiver>>> receivers;
  std::optional<Call> call;
  Partner partner;  // ends before what listens to it
  if (!folder.empty()) {
    std::filesystem::create_directories(folder);
    partner.watch(std::filesystem::path(folder) / "graph.txt");
    std::istringstream list(options["topics"]);
    for (std::string item; std::getline(list, item, ',');) {
      const std::size_t at = item.find('=');
      const std::string topic = item.substr(0, at);
      const std::string type = item.substr(at + 1);
      // One that is no topic of ROS, and those of which a late subscriber gets the last message.
      const bool plain = topic == "ros_discovery_info";
      const bool latest = plain || topic == "/tf_static" || topic.ends_with("/map");
      receivers.emplace_back(topic, std::make_unique<Receiver>(folder, topic));
      partner.read_from(plain ? topic : "rt" + topic, mms::msg::dds_type_name(type), latest,
                        receivers.back().second.get());
    }
  }
  if (!options["call"].empty()) {
    call.emplace(partner, options["call"], options["map"], folder, end);
  }
  const auto send = [&] {
    if (call) call->send();
  };
  if (options["play"].empty()) {
    send();
  } else {
    play(partner, options, end, send);
  }
  if (!options["expect"].empty()) {
    const auto expected = static_cast<std::size_t>(std::atoll(options["expect"].c_str()));
    const Receiver& first = *receivers.front().second;
    try {
      wait_until([&] { return first.count() >= expected; }, end, "messages are missing");
    } catch (const std::exception&) {
      std::printf("%s %zu\n", receivers.front().first.c_str(), first.count());
      throw;
    }
  }
  if (call) call->print_reply();
  for (const auto& [topic, receiver] : receivers) {
    std::printf("%s %zu\n", topic.c_str(), receiver->count());
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
