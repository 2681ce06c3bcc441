#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace mms::onnx {

/// One field of a protobuf message.
struct ProtobufField {
  std::uint64_t number = 0;
  std::uint64_t value = 0;  ///< of a number; of 0 for bytes
  std::string_view bytes;   ///< a text or a nested message; empty for a number
};

/// Goes over the fields of a protobuf message without knowing its schema.
class ProtobufReader {
 public:
  /// @param message  has to outlive the reader and its fields
  /// @param where    what errors call the file
  ProtobufReader(std::string_view message, const std::string& where)
      : message_(message), where_(where) {}

  /// The next field; nothing at the end. @throws DataError where the bytes make no field.
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
