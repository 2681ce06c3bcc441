#include "mms/ros2/dds_settings.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>

#include "mms/core/error.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace {

constexpr int kMaxDomain = 232;                  // its ports end at 65535
constexpr std::int64_t kBlocking = 100'000'000;  // longest wait of a writer [ns], ROS 2's default

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

void fail_dds(const std::string& what, dds_return_t code) {
  throw Error("ROS 2", what + ": " + dds_strretcode(-code));
}

dds_entity_t checked_entity(dds_entity_t entity, const std::string& what) {
  if (entity < 0) fail_dds(what, entity);
  return entity;
}

std::uint32_t domain_id() {
  const std::string text = environment("ROS_DOMAIN_ID");
  if (text.empty()) return 0;
  const auto id = parse_integer(text);
  if (id && *id >= 0 && *id <= kMaxDomain) return static_cast<std::uint32_t>(*id);
  throw ConfigError("ROS_DOMAIN_ID",
                    "is '" + text + "', allowed: 0 to " + std::to_string(kMaxDomain));
}

std::string dds_settings() {
  // Datagrams of up to 64 kB in place of 14 kB: fewer system calls for clouds and maps.
  std::string settings =
      "<CycloneDDS><Domain><General><MaxMessageSize>65500B</MaxMessageSize>"
      "<FragmentSize>63000B</FragmentSize>";
  const bool is_local = environment("ROS_LOCALHOST_ONLY") == "1" ||
                        environment("ROS_AUTOMATIC_DISCOVERY_RANGE") == "LOCALHOST";
  if (is_local) {
    settings +=
        R"(<Interfaces><NetworkInterface address="127.0.0.1" multicast="false"/></Interfaces>)";
  }
  settings += "</General>";
  if (is_local) {  // without multicast each process needs a number, and a robot has more than ten
    settings +=
        "<Discovery><ParticipantIndex>auto</ParticipantIndex>"
        "<MaxAutoParticipantIndex>99</MaxAutoParticipantIndex></Discovery>";
  }
  // A color and a depth image of 640x480 have 1.5 MB; as much as the system allows.
  settings += "<Internal><SocketReceiveBufferSize max=\"16MB\"/></Internal></Domain></CycloneDDS>";
  const std::string own = environment("CYCLONEDDS_URI");
  return own.empty() ? settings : settings + "," + own;
}

Qos qos_of(const TopicQos& topic, bool reliable, const std::string& user_data) {
  Qos qos(dds_create_qos());
  dds_qset_reliability(qos.get(), reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                       kBlocking);
  const auto history = topic.depth > 0 ? DDS_HISTORY_KEEP_LAST : DDS_HISTORY_KEEP_ALL;
  dds_qset_history(qos.get(), history, topic.depth);
  if (topic.transient_local) {
    dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
    // What later subscribers get is a history of its own in DDS.
    dds_qset_durability_service(qos.get(), 0, history, topic.depth, DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  }
  dds_qset_writer_data_lifecycle(qos.get(), false);
  if (!user_data.empty()) dds_qset_userdata(qos.get(), user_data.data(), user_data.size());
  return qos;
}

DdsGuid guid_of(dds_entity_t entity) {
  dds_guid_t guid{};
  const dds_return_t code = dds_get_guid(entity, &guid);
  if (code < 0) fail_dds("no identifier of an endpoint", code);
  DdsGuid result;
  std::copy(std::begin(guid.v), std::end(guid.v), result.begin());
  return result;
}

}  // namespace mms
