#pragma once

#include <cstdint>
#include <string>

namespace mms {

/// Address of the viewer.
struct ViewOptions {
  std::uint16_t port = 8080;
  std::string bind = "127.0.0.1";
};

}  // namespace mms
