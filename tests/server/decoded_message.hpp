#pragma once

#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace mms::testing {

/// A binary message decoded according to docs/viewer_protocol.md, independent of the server's code.
struct DecodedMessage {
  nlohmann::json json;
  std::map<std::string, std::string> buffers;  ///< raw bytes by name

  std::string type() const { return json.at("type").get<std::string>(); }

  template <class Value>
  std::vector<Value> values(const std::string& name) const {
    const std::string& bytes = buffers.at(name);
    std::vector<Value> values(bytes.size() / sizeof(Value));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }
};

/// @throws std::runtime_error when the message breaks the protocol.
inline DecodedMessage decode_message(std::string_view bytes) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::runtime_error(what);
  };
  std::uint32_t size = 0;
  require(bytes.size() >= sizeof size, "no size");
  std::memcpy(&size, bytes.data(), sizeof size);
  require(size % 4 == 0 && size <= bytes.size() - sizeof size, "wrong size of the JSON");
  DecodedMessage message;
  message.json = nlohmann::json::parse(bytes.substr(sizeof size, size));
  std::size_t at = sizeof size + size;
  const std::map<std::string, std::size_t> sizes = {{"f32", 4}, {"u32", 4}, {"u8", 1}};
  for (const auto& buffer : message.json.at("buffers")) {
    const std::size_t length = sizes.at(buffer.at("dtype").get<std::string>()) *
                               buffer.at("components").get<std::size_t>() *
                               buffer.at("count").get<std::size_t>();
    require(at % 4 == 0 && at + length <= bytes.size(), "a buffer is truncated");
    message.buffers[buffer.at("name").get<std::string>()] = bytes.substr(at, length);
    at += (length + 3) / 4 * 4;
  }
  require(at == bytes.size(), "bytes after the last buffer");
  return message;
}

}  // namespace mms::testing
