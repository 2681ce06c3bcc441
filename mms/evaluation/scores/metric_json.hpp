#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "mms/evaluation/scores/metric_value.hpp"

namespace mms {

/// The object of `to_json`, as part of larger ones. For .cpp files only: the JSON library is not
/// part of this module's interface.
nlohmann::ordered_json json_object(std::span<const MetricValue> values);

}  // namespace mms
