#pragma once

#include <vector>

#include "mms/pipeline/system_config.hpp"
#include "mms/ros2/parameter_messages.hpp"
#include "mms/ros2/ros2_node.hpp"

namespace mms {

/// A setting as a parameter of ROS 2.
struct Ros2Parameter {
  msg::ParameterDescriptor descriptor;
  msg::ParameterValue value;
};

/// All settings but lists, by names as "static_map.voxel_size", in their order.
std::vector<Ros2Parameter> parameters_of(SystemConfig config);

/// Names of parameters, as the service ListParameters selects them.
msg::ListParametersReply list_parameters(const std::vector<Ros2Parameter>& parameters,
                                         const msg::ListParametersRequest& request);

/// Offers the services by which `ros2 param` lists, describes and reads the settings of a node.
/// They cannot be set.
void offer_parameters(Ros2Node& node, const SystemConfig& config);

}  // namespace mms
