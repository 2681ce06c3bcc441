#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace mms::testing {

/// The first fault of a value by a JSON schema, with its path; empty if there is none. Knows type,
/// enum, minimum, maximum, properties, required, additionalProperties, items, minItems, maxItems
/// and $ref to #/$defs/NAME of the schema's root.
std::string schema_fault(const nlohmann::json& value, const nlohmann::json& schema);

}  // namespace mms::testing
