#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mms::onnx {

/// The names in "person, traffic light", trimmed; a name must not be empty. @return empty for a
/// blank text
/// @throws DataError at `where` for an empty name.
std::vector<std::string> listed_names(std::string_view text, const std::string& where);

/// The names in a Python literal, as in the metadata of YOLO models: "{0: 'person', 1: 'traffic
/// light'}" or "['person', 'traffic light']". @return by number; empty for any other text or if a
/// number is missing
std::vector<std::string> python_names(std::string_view text);

}  // namespace mms::onnx
