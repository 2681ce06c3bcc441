#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mms {

/// A message in wire format, shared by its recipients.
using Message = std::shared_ptr<const std::string>;

/// Encodes a binary message (docs/viewer_protocol.md): size of the JSON, the JSON with the list of
/// buffers, the buffers, each aligned to four bytes; little-endian.
class MessageWriter {
 public:
  /// @param json  an object with its "type"
  explicit MessageWriter(nlohmann::json json) : json_(std::move(json)) {}

  /// Adds a buffer of values.
  /// @param components  numbers per element, such as 3 of a point
  void add(std::string_view name, std::span<const float> values, int components);
  void add(std::string_view name, std::span<const std::uint32_t> values, int components);
  void add(std::string_view name, std::span<const std::uint8_t> values, int components);

  /// The encoded message. Invalid UTF-8 in JSON texts is replaced.
  Message finish();

 private:
  void add_bytes(std::string_view name, std::string_view type, std::string_view bytes,
                 std::size_t elements, int components);

  nlohmann::json json_;
  nlohmann::json buffers_ = nlohmann::json::array();
  std::string data_;
};

}  // namespace mms
