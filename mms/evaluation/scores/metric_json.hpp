#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "mms/evaluation/scores/metric_value.hpp"

namespace mms {

/// The object behind `to_json`, for building larger ones. For .cpp files only: the JSON library is
/// no part of this module's interface.
nlohmann::ordered_json json_object(std::span<const MetricValue> values);

}  // namespace mms
