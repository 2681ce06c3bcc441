#pragma once

#include <cstdint>

namespace mms::msg {

/// What rmw_cyclonedds_cpp puts before the fields of requests and replies.
struct RequestHeader {
  std::uint64_t client = 0;
  std::int64_t number = 0;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {  ///< see wire.hpp
    archive(self.client, self.number);
  }
};

/// A request or reply on the wire.
template <class Body>
struct Numbered {
  RequestHeader header{};
  Body body{};

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {  ///< see wire.hpp
    archive(self.header, self.body);
  }
};

}  // namespace mms::msg
