#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mms::onnx {

/// The names in "person, traffic light", without the space around them; a name may not be empty.
/// @return nothing for a blank text
/// @throws DataError at `where` for an empty name.
std::vector<std::string> listed_names(std::string_view text, const std::string& where);

/// The names in a Python literal, as YOLO's tools write them into a model's metadata:
/// "{0: 'person', 1: 'traffic light'}" or "['person', 'traffic light']".
/// @return by their number; nothing when the text is anything else or a number is missing
std::vector<std::string> python_names(std::string_view text);

}  // namespace mms::onnx
