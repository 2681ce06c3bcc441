#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "mms/ros/message_types.hpp"
#include "mms/ros/wire.hpp"
#include "mms/ros2/raw_sample.hpp"
#include "mms/ros2/service_messages.hpp"

namespace mms {

/// The place of a node in the graph of ROS 2.
struct Ros2NodeOptions {
  std::string name = "mms_slam";
  std::string name_space = "/";
  std::string distro = "jazzy";  ///< "humble", "iron", "jazzy", ...: see `kRos2Distros`
};

/// Quality of service of a topic.
struct TopicQos {
  enum class Reliability {
    kReliable,
    kBestEffort,
    kAsPublishers  ///< of a subscription: reliable where all publishers are, as `ros2 topic echo`
  };

  Reliability reliability = Reliability::kReliable;
  bool transient_local = false;  ///< later subscribers get the last `depth` messages
  int depth = 10;                ///< messages kept; 0: all
};

class Ros2Node;

/// Publishes the messages of a topic. Thread-safe.
class Ros2Writer {
 public:
  Ros2Writer() = default;

  /// Whether anybody subscribes.
  bool is_wanted() const;

  /// Messages that could not be sent in time are dropped.
  template <class Message>
  void publish(const Message& message) const {
    const RawSample raw = make_raw_sample(type_, msg::encoded_size(message, msg::WireFormat::kCdr));
    try {
      msg::encode(message, reinterpret_cast<std::uint8_t*>(raw.data), msg::WireFormat::kCdr);
    } catch (...) {
      release(raw.sample);
      throw;
    }
    send(raw.sample);
  }

 private:
  friend class Ros2Node;
  void send(ddsi_serdata* sample) const;

  std::int32_t entity_ = 0;
  const ddsi_sertype* type_ = nullptr;
};

/// Result of a service std_srvs/Trigger.
struct TriggerResult {
  bool success = false;
  std::string message;
};

/// A node in the graph of ROS 2 by Cyclone DDS, without ROS: one participant of the domain
/// ROS_DOMAIN_ID, which DDS programs and nodes of other machines see as a node.
class Ros2Node {
 public:
  using BytesHandler = std::function<void(std::string_view bytes)>;
  using Reply = std::function<void(const TriggerResult&)>;
  using TriggerHandler = std::function<void(Reply)>;
  using ErrorHandler = std::function<void(const std::string& message)>;

  /// @param on_error  receives what the handlers throw, in the receiving thread
  /// @throws ConfigError for a wrong name, distribution or domain; Error if DDS fails.
  Ros2Node(const Ros2NodeOptions& options, ErrorHandler on_error);
  ~Ros2Node();
  Ros2Node(const Ros2Node&) = delete;
  Ros2Node& operator=(const Ros2Node&) = delete;

  // Topics are added before `start`. Names as in `full_topic_name`.

  template <class Message>
  Ros2Writer advertise(const std::string& topic, const TopicQos& qos) {
    return advertise(topic, msg::message_type(msg::kName<Message>), qos);
  }

  template <class Message, class Handler>
  void subscribe(const std::string& topic, const TopicQos& qos, Handler handler) {
    subscribe(topic, msg::message_type(msg::kName<Message>), qos,
              [topic, handler = std::move(handler)](std::string_view bytes) {
                handler(msg::decode<Message>(bytes, topic, msg::WireFormat::kCdr));
              });
  }

  /// Offers a service of the type std_srvs/Trigger, as nodes on rmw_cyclonedds_cpp do. The handler
  /// may reply later, in any thread, as long as there is the node.
  void serve(const std::string& name, TriggerHandler handler);

  /// Offers a service of another type, as "rcl_interfaces/GetParameters". The handler gives the
  /// reply of a request, in the receiving thread.
  template <class Request, class Response, class Handler>
  void answer(const std::string& name, const std::string& type, Handler handler) {
    const Ros2Writer replies = advertise_replies(name, type);
    receive_requests(
        name, type, [replies, name, handler = std::move(handler)](std::string_view bytes) {
          const auto request =
              msg::decode<msg::Numbered<Request>>(bytes, name, msg::WireFormat::kCdr);
          replies.publish(msg::Numbered<Response>{request.header, handler(request.body)});
        });
  }

  /// Calls `tick` in the receiving thread about every `period` seconds.
  void every(double period, std::function<void()> tick);

  /// Starts to receive, in a thread.
  void start();

  /// Ends the thread; no handler is called afterwards.
  void stop();

  const std::string& name_space() const;
  /// "/mms_slam", with the namespace.
  std::string full_name() const;
  int domain() const;

 private:
  class Graph;

  Ros2Writer advertise(const std::string& topic, const msg::MessageType& type, const TopicQos& qos);
  void subscribe(const std::string& topic, const msg::MessageType& type, const TopicQos& qos,
                 BytesHandler handler);
  Ros2Writer advertise_replies(const std::string& service, const std::string& type);
  void receive_requests(const std::string& service, const std::string& type, BytesHandler handler);

  std::unique_ptr<Graph> graph_;
};

}  // namespace mms
