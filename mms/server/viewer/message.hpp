#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mms {

/// A message as it goes over the wire, shared by the clients it goes to.
using Message = std::shared_ptr<const std::string>;

/// Puts a binary message together (docs/viewer_protocol.md): the JSON's size, the JSON with the
/// list of buffers, the buffers, each at a multiple of four bytes; little-endian.
class MessageWriter {
 public:
  /// @param json  an object with its "type"
  explicit MessageWriter(nlohmann::json json) : json_(std::move(json)) {}

  /// Adds a buffer of values. @param components  numbers an element, as 3 of a point
  void add(std::string_view name, std::span<const float> values, int components);
  void add(std::string_view name, std::span<const std::uint32_t> values, int components);
  void add(std::string_view name, std::span<const std::uint8_t> values, int components);

  /// The whole message. What is no UTF-8 in the JSON's texts is replaced.
  Message finish();

 private:
  void add_bytes(std::string_view name, std::string_view type, std::string_view bytes,
                 std::size_t elements, int components);

  nlohmann::json json_;
  nlohmann::json buffers_ = nlohmann::json::array();
  std::string data_;
};

}  // namespace mms
