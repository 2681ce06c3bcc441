#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace mms::testing {

/// Writes a protobuf message field by field.
class ProtobufWriter {
 public:
  ProtobufWriter& number(std::uint64_t field, std::uint64_t value) {
    varint(field << 3);
    varint(value);
    return *this;
  }
  /// A text or a nested message.
  ProtobufWriter& bytes(std::uint64_t field, std::string_view value) {
    varint(field << 3 | 2);
    varint(value.size());
    message_ += value;
    return *this;
  }
  const std::string& message() const { return message_; }

 private:
  void varint(std::uint64_t value) {
    for (; value >= 128; value >>= 7) message_ += static_cast<char>(value % 128 + 128);
    message_ += static_cast<char>(value);
  }

  std::string message_;
};

}  // namespace mms::testing
