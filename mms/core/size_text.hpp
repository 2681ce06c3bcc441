#pragma once

#include <string>

namespace mms {

/// "640x480", for messages.
template <class Side>
std::string size_text(Side width, Side height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

}  // namespace mms
