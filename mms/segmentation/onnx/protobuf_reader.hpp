#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace mms::onnx {

/// One field of a protobuf message.
struct ProtobufField {
  std::uint64_t number = 0;
  std::uint64_t value = 0;  ///< of a numeric field; 0 for bytes
  std::string_view bytes;   ///< a string or a nested message; empty for a number
};

/// Iterates over the fields of a protobuf message without its schema.
class ProtobufReader {
 public:
  /// @param message  has to outlive the reader and its fields
  /// @param where    name of the file in messages
  ProtobufReader(std::string_view message, const std::string& where)
      : message_(message), where_(where) {}

  /// The next field; nullopt at the end.
  /// @throws DataError for an invalid field.
  std::optional<ProtobufField> next();

 private:
  std::uint64_t varint();
  std::string_view take(std::uint64_t size);
  [[noreturn]] void fail(const std::string& what) const;

  std::string_view message_;
  const std::string& where_;
  std::size_t at_ = 0;
};

}  // namespace mms::onnx
