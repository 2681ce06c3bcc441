#include "mms/server/viewer/message.hpp"

#include <bit>

namespace mms {
namespace {

static_assert(std::endian::native == std::endian::little, "buffers are sent bytewise");

constexpr std::size_t kAlignment = 4;

void pad(std::string& text, char with) {
  while (text.size() % kAlignment != 0) text.push_back(with);
}

template <class Value>
std::string_view bytes_of(std::span<const Value> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

}  // namespace

void MessageWriter::add(std::string_view name, std::span<const float> values, int components) {
  add_bytes(name, "f32", bytes_of(values), values.size(), components);
}

void MessageWriter::add(std::string_view name, std::span<const std::uint32_t> values,
                        int components) {
  add_bytes(name, "u32", bytes_of(values), values.size(), components);
}

void MessageWriter::add(std::string_view name, std::span<const std::uint8_t> values,
                        int components) {
  add_bytes(name, "u8", bytes_of(values), values.size(), components);
}

void MessageWriter::add_bytes(std::string_view name, std::string_view type, std::string_view bytes,
                              std::size_t elements, int components) {
  buffers_.push_back({{"name", name},
                      {"dtype", type},
                      {"components", components},
                      {"count", elements / static_cast<std::size_t>(components)}});
  data_.append(bytes);
  pad(data_, '\0');
}

Message MessageWriter::finish() {
  json_["buffers"] = std::move(buffers_);
  std::string json = json_.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  pad(json, ' ');
  const auto size = static_cast<std::uint32_t>(json.size());
  auto message = std::make_shared<std::string>();
  message->reserve(sizeof size + json.size() + data_.size());
  message->append(reinterpret_cast<const char*>(&size), sizeof size);
  message->append(json);
  message->append(data_);
  return message;
}

}  // namespace mms
