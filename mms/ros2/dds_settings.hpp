#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <memory>
#include <string>

#include "mms/ros2/discovery_info.hpp"
#include "mms/ros2/ros2_node.hpp"

namespace mms {

/// @throws Error with what failed and the reason of the code
[[noreturn]] void fail_dds(const std::string& what, dds_return_t code);

/// The entity. @throws Error with what failed, if it is an error code
dds_entity_t checked_entity(dds_entity_t entity, const std::string& what);

/// Frees a quality of service of DDS.
struct DeleteQos {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }  ///< called by std::unique_ptr
};
using Qos = std::unique_ptr<dds_qos_t, DeleteQos>;

/// Number of ROS_DOMAIN_ID; 0 without it. @throws ConfigError if it is not in range
std::uint32_t domain_id();

/// Settings of Cyclone DDS as XML: ours, then those of CYCLONEDDS_URI, which win.
std::string dds_settings();

/// Quality of service of a topic as ROS 2 sets it.
/// @param user_data  of the endpoint, as the hash of its type; may be empty
Qos qos_of(const TopicQos& topic, bool reliable, const std::string& user_data);

/// @throws Error if DDS gives none
DdsGuid guid_of(dds_entity_t entity);

}  // namespace mms
