#include "mms/segmentation/onnx/protobuf_reader.hpp"

#include "mms/core/error.hpp"

namespace mms::onnx {
namespace {

enum WireType : std::uint64_t { kVarint = 0, kFixed64 = 1, kBytes = 2, kFixed32 = 5 };

}  // namespace

std::optional<ProtobufField> ProtobufReader::next() {
  if (at_ == message_.size()) return std::nullopt;
  const std::uint64_t tag = varint();
  ProtobufField field{tag >> 3, 0, {}};
  if (field.number == 0) fail("has a field without a number");
  switch (tag & 7) {
    case kVarint:
      field.value = varint();
      break;
    case kFixed64:
      take(8);
      break;
    case kBytes:
      field.bytes = take(varint());
      break;
    case kFixed32:
      take(4);
      break;
    default:
      fail("has a field of the unknown type " + std::to_string(tag & 7));
  }
  return field;
}

std::uint64_t ProtobufReader::varint() {
  std::uint64_t value = 0;
  for (unsigned shift = 0; shift < 64; shift += 7) {
    const auto byte = static_cast<unsigned char>(take(1).front());
    value |= static_cast<std::uint64_t>(byte & 0x7FU) << shift;
    if (byte < 0x80U) return value;
  }
  fail("has a number of more than 64 bits");
}

std::string_view ProtobufReader::take(std::uint64_t size) {
  const std::size_t left = message_.size() - at_;
  if (size > left) {
    fail("has a field of " + std::to_string(size) + " bytes, but only " + std::to_string(left) +
         " are left");
  }
  const std::string_view taken = message_.substr(at_, static_cast<std::size_t>(size));
  at_ += taken.size();
  return taken;
}

void ProtobufReader::fail(const std::string& what) const {
  throw DataError(where_, "is not a complete ONNX model: it " + what,
                  "is it an .onnx file, and was it copied completely?");
}

}  // namespace mms::onnx
