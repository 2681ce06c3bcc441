#include "mms/ros2/ros2_node.hpp"

#include <dds/dds.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/ros/topic_names.hpp"
#include "mms/ros/type_hash.hpp"
#include "mms/ros2/dds_settings.hpp"
#include "mms/ros2/discovery_info.hpp"

namespace mms {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kHumble = "humble";
constexpr std::array kRos2Distros = {kHumble, "iron", "jazzy", "kilted", "lyrical", "rolling"};
constexpr std::int64_t kWake = 50'000'000;  // longest sleep of the receiving thread [ns]
constexpr std::uint32_t kTaken = 16;        // samples per call

struct TriggerReply {
  bool success = false;
  std::string message;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.success, self.message);
  }
};

}  // namespace

bool Ros2Writer::is_wanted() const {
  dds_publication_matched_status_t status{};
  return entity_ > 0 && dds_get_publication_matched_status(entity_, &status) >= 0 &&
         status.current_count > 0;
}

void Ros2Writer::send(ddsi_serdata* sample) const {
  if (entity_ <= 0) return release(sample);
  dds_writecdr(entity_, sample);  // fails only where a slow subscriber holds up a full history
}

class Ros2Node::Graph {
 public:
  Graph(const Ros2NodeOptions& options, ErrorHandler on_error)
      : options_(options), on_error_(std::move(on_error)) {
    msg::check_node_name(options_.name, "--node-name");
    options_.name_space = msg::full_namespace(options_.name_space, "--namespace");
    if (std::find(kRos2Distros.begin(), kRos2Distros.end(), options_.distro) ==
        kRos2Distros.end()) {
      throw ConfigError(
          "--ros-distro",
          "is '" + options_.distro + "', allowed: humble, iron, jazzy, kilted, lyrical, rolling");
    }
    domain_ = domain_id();
    const dds_entity_t own = dds_create_domain(domain_, dds_settings().c_str());
    if (own > 0) {
      domain_entity_ = own;
    } else if (own !=
               DDS_RETCODE_PRECONDITION_NOT_MET) {  // else another node of this process made it
      fail_dds("cannot join the domain " + std::to_string(domain_), own);
    }
    try {
      open();
    } catch (...) {
      if (domain_entity_ > 0) dds_delete(domain_entity_);
      throw;
    }
  }

  ~Graph() {
    stop();
    if (participant_ > 0) dds_delete(participant_);
    if (domain_entity_ > 0) dds_delete(domain_entity_);
  }

  Graph(const Graph&) = delete;
  Graph& operator=(const Graph&) = delete;

  std::string full(const std::string& name) const {
    return msg::full_topic_name(name, options_.name_space, options_.name, name);
  }

  std::pair<dds_entity_t, const ddsi_sertype*> add_writer(const std::string& dds_topic,
                                                          const std::string& dds_type,
                                                          const TopicQos& topic,
                                                          const std::string& hash) {
    const auto [entity, type] = add_topic(dds_topic, dds_type);
    const Qos qos = qos_of(topic, topic.reliability == TopicQos::Reliability::kReliable, hash);
    const dds_entity_t writer = checked_entity(
        dds_create_writer(participant_, entity, qos.get(), nullptr), "cannot publish " + dds_topic);
    return {writer, type};
  }

  void add_reader(const std::string& dds_topic, const std::string& dds_type, const TopicQos& topic,
                  const std::string& hash, BytesHandler handler) {
    Subscription subscription;
    subscription.topic = add_topic(dds_topic, dds_type).first;
    subscription.name = dds_topic;
    subscription.qos = topic;
    subscription.user_data = hash;
    subscription.handler = std::move(handler);
    open_reader(subscription, topic.reliability == TopicQos::Reliability::kReliable);
    subscriptions_.push_back(std::move(subscription));
  }

  /// "typehash=RIHS01_...;" since Iron.
  std::string hash_of(std::string_view name, std::string_view definition) const {
    if (options_.distro == kHumble) return "";
    std::string full_type(name);
    full_type.insert(full_type.find('/'), "/msg");
    return "typehash=" + msg::type_hash(full_type, definition) + ";";
  }

  void remember(dds_entity_t writer) {
    writers_.push_back(guid_of(writer));
    announce();
  }

  void announce() {
    DiscoveryInfo info;
    info.participant = guid_of(participant_);
    info.node_namespace = options_.name_space;
    info.node_name = options_.name;
    info.writers = writers_;
    for (const Subscription& subscription : subscriptions_) {
      info.readers.push_back(guid_of(subscription.reader));
    }
    if (options_.distro == kHumble) {
      info_.publish(ParticipantEntitiesInfo<24>(info));
    } else {
      info_.publish(ParticipantEntitiesInfo<16>(info));
    }
  }

  void every(double period, std::function<void()> tick) {
    const auto interval =
        std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(period));
    ticks_.push_back({interval, Clock::now() + interval, std::move(tick)});
  }

  void start() {
    stopping_ = false;
    thread_ = std::thread([this] { receive(); });
  }

  void stop() {
    stopping_ = true;
    if (thread_.joinable()) thread_.join();
  }

  const Ros2NodeOptions& options() const { return options_; }
  int domain() const { return static_cast<int>(domain_); }

 private:
  struct Subscription {
    dds_entity_t topic = 0;
    std::string name;
    TopicQos qos;
    std::string user_data;
    BytesHandler handler;
    dds_entity_t reader = 0;
    dds_entity_t condition = 0;
    bool reliable = false;
    bool mixed = false;  ///< a publisher is not reliable
  };
  struct Tick {
    Clock::duration interval;
    Clock::time_point next;
    std::function<void()> call;
  };

  void open() {
    Qos qos(dds_create_qos());
    const std::string enclave = "enclave=/;";
    dds_qset_userdata(qos.get(), enclave.data(), enclave.size());
    participant_ = checked_entity(dds_create_participant(domain_, qos.get(), nullptr),
                                  "cannot join the domain " + std::to_string(domain_));
    waitset_ = checked_entity(dds_create_waitset(participant_), "no wait set");
    const TopicQos latest{TopicQos::Reliability::kReliable, true, 1};
    const auto [writer, type] =
        add_writer("ros_discovery_info", msg::dds_type_name(DiscoveryInfo::kTypeName), latest,
                   hash_of(DiscoveryInfo::kTypeName, DiscoveryInfo::kDefinition));
    info_.entity_ = writer;
    info_.type_ = type;
    announce();
  }

  std::pair<dds_entity_t, const ddsi_sertype*> add_topic(const std::string& name,
                                                         const std::string& dds_type) {
    ddsi_sertype* type = make_raw_type(dds_type);
    const dds_entity_t topic =
        dds_create_topic_sertype(participant_, name.c_str(), &type, nullptr, nullptr, nullptr);
    return {checked_entity(topic, "no topic " + name + " of type " + dds_type), type};
  }

  void open_reader(Subscription& subscription, bool reliable) {
    const Qos qos = qos_of(subscription.qos, reliable, subscription.user_data);
    subscription.reader =
        checked_entity(dds_create_reader(participant_, subscription.topic, qos.get(), nullptr),
                       "cannot subscribe to " + subscription.name);
    subscription.reliable = reliable;
    subscription.condition = checked_entity(
        dds_create_readcondition(subscription.reader, DDS_ANY_STATE), "no condition");
    dds_waitset_attach(waitset_, subscription.condition, 0);
  }

  void reopen(Subscription& subscription, bool reliable) {
    take(subscription);  // what has arrived
    dds_waitset_detach(waitset_, subscription.condition);
    dds_delete(subscription.reader);
    open_reader(subscription, reliable);
    announce();
  }

  /// Whether all publishers of the topic are reliable; nullopt without any.
  static std::optional<bool> are_reliable(dds_entity_t reader) {
    std::array<dds_instance_handle_t, 16> handles{};
    const dds_return_t count = dds_get_matched_publications(reader, handles.data(), handles.size());
    if (count <= 0) return std::nullopt;
    bool all = true;
    const auto known = std::min(static_cast<std::size_t>(count), handles.size());
    for (std::size_t i = 0; i < known; ++i) {
      dds_builtintopic_endpoint_t* endpoint = dds_get_matched_publication_data(reader, handles[i]);
      if (endpoint == nullptr) return std::nullopt;
      dds_reliability_kind_t kind = DDS_RELIABILITY_BEST_EFFORT;
      all = dds_qget_reliability(endpoint->qos, &kind, nullptr) &&
            kind == DDS_RELIABILITY_RELIABLE && all;
      dds_builtintopic_free_endpoint(endpoint);
    }
    return all;
  }

  /// A reliable subscription gets nothing of other publishers, and one that is not loses messages.
  void adapt(Subscription& subscription) {
    if (subscription.qos.reliability != TopicQos::Reliability::kAsPublishers) return;
    if (subscription.reliable) {
      dds_requested_incompatible_qos_status_t status{};
      dds_get_requested_incompatible_qos_status(subscription.reader, &status);
      if (status.total_count == 0) return;
      subscription.mixed = true;
      reopen(subscription, false);
    } else if (const auto reliable = are_reliable(subscription.reader)) {
      if (!*reliable) subscription.mixed = true;
      if (*reliable && !subscription.mixed) reopen(subscription, true);
    } else {
      subscription.mixed = false;
    }
  }

  void take(Subscription& subscription) {
    std::array<ddsi_serdata*, kTaken> samples{};
    std::array<dds_sample_info_t, kTaken> infos{};
    while (true) {
      const dds_return_t count =
          dds_takecdr(subscription.reader, samples.data(), kTaken, infos.data(), DDS_ANY_STATE);
      if (count <= 0) return;
      for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        const std::unique_ptr<ddsi_serdata, void (*)(ddsi_serdata*)> sample(samples[i], release);
        if (!infos[i].valid_data) continue;
        try {
          subscription.handler(bytes_of(sample.get()));
        } catch (const std::exception& error) {
          on_error_(error.what());
        }
      }
    }
  }

  void receive() {
    while (!stopping_) {
      dds_waitset_wait(waitset_, nullptr, 0, kWake);
      for (Subscription& subscription : subscriptions_) take(subscription);
      const auto now = Clock::now();
      if (now >= next_adaptation_) {
        for (Subscription& subscription : subscriptions_) adapt(subscription);
        next_adaptation_ = now + std::chrono::nanoseconds(kWake);
      }
      for (Tick& tick : ticks_) {
        if (now < tick.next) continue;
        tick.next = now + tick.interval;
        try {
          tick.call();
        } catch (const std::exception& error) {
          on_error_(error.what());
        }
      }
    }
  }

  Ros2NodeOptions options_;
  ErrorHandler on_error_;
  std::uint32_t domain_ = 0;
  dds_entity_t domain_entity_ = 0;
  dds_entity_t participant_ = 0;
  dds_entity_t waitset_ = 0;
  Ros2Writer info_;
  std::vector<DdsGuid> writers_;
  std::vector<Subscription> subscriptions_;
  std::vector<Tick> ticks_;
  Clock::time_point next_adaptation_;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

Ros2Node::Ros2Node(const Ros2NodeOptions& options, ErrorHandler on_error)
    : graph_(std::make_unique<Graph>(options, std::move(on_error))) {}

Ros2Node::~Ros2Node() = default;

Ros2Writer Ros2Node::advertise(const std::string& topic, const msg::MessageType& type,
                               const TopicQos& qos) {
  Ros2Writer writer;
  const auto [entity, raw_type] =
      graph_->add_writer("rt" + graph_->full(topic), msg::dds_type_name(type.name), qos,
                         graph_->hash_of(type.name, type.ros2_definition));
  writer.entity_ = entity;
  writer.type_ = raw_type;
  graph_->remember(entity);
  return writer;
}

void Ros2Node::subscribe(const std::string& topic, const msg::MessageType& type,
                         const TopicQos& qos, BytesHandler handler) {
  graph_->add_reader("rt" + graph_->full(topic), msg::dds_type_name(type.name), qos,
                     graph_->hash_of(type.name, type.ros2_definition), std::move(handler));
  graph_->announce();
}

Ros2Writer Ros2Node::advertise_replies(const std::string& service, const std::string& type) {
  Ros2Writer replies;
  const auto [entity, raw_type] =
      graph_->add_writer("rr" + graph_->full(service) + "Reply",
                         msg::dds_type_name(type + "_Response", "srv"), TopicQos{}, "");
  replies.entity_ = entity;
  replies.type_ = raw_type;
  graph_->remember(entity);
  return replies;
}

void Ros2Node::receive_requests(const std::string& service, const std::string& type,
                                BytesHandler handler) {
  graph_->add_reader("rq" + graph_->full(service) + "Request",
                     msg::dds_type_name(type + "_Request", "srv"), TopicQos{}, "",
                     std::move(handler));
  graph_->announce();
}

void Ros2Node::serve(const std::string& name, TriggerHandler handler) {
  const Ros2Writer replies = advertise_replies(name, "std_srvs/Trigger");
  receive_requests(
      name, "std_srvs/Trigger",
      [replies, name, handler = std::move(handler)](std::string_view bytes) {
        const auto header = msg::decode<msg::RequestHeader>(bytes, name, msg::WireFormat::kCdr);
        handler([replies, header](const TriggerResult& result) {
          replies.publish(msg::Numbered<TriggerReply>{header, {result.success, result.message}});
        });
      });
}

void Ros2Node::every(double period, std::function<void()> tick) {
  graph_->every(period, std::move(tick));
}

void Ros2Node::start() {
  graph_->start();
}

void Ros2Node::stop() {
  graph_->stop();
}

const std::string& Ros2Node::name_space() const {
  return graph_->options().name_space;
}

std::string Ros2Node::full_name() const {
  return (name_space() == "/" ? "/" : name_space() + "/") + graph_->options().name;
}

int Ros2Node::domain() const {
  return graph_->domain();
}

}  // namespace mms
