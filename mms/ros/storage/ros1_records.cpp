#include "mms/ros/storage/ros1_records.hpp"

#include <algorithm>

#include "mms/core/error.hpp"

namespace mms {
namespace {

constexpr std::int64_t kNanoseconds = 1'000'000'000;  // per second
constexpr std::size_t kMaxFields = 100;  // of a header; that of a connection has about six
constexpr std::uint64_t kLowBits = 0xFFFF'FFFF;

}  // namespace

Ros1Fields::Ros1Fields(std::string_view bytes) {
  ByteReader reader(bytes, "the header of a record");
  while (reader.left() > 0) {
    const std::string_view field = reader.take(reader.take_count(1));
    const std::size_t equals = field.find('=');
    if (equals == std::string_view::npos) throw DataError(reader.where(), "has an unnamed value");
    if (values_.size() == kMaxFields) {
      throw DataError(reader.where(), "has more than " + std::to_string(kMaxFields) + " values");
    }
    values_.emplace_back(field.substr(0, equals), field.substr(equals + 1));
  }
}

std::string_view Ros1Fields::text(std::string_view name) const {
  const auto found = std::find_if(values_.begin(), values_.end(),
                                  [&](const auto& value) { return value.first == name; });
  return found == values_.end() ? std::string_view() : std::string_view(found->second);
}

Timestamp ros1_time(std::uint64_t bits) {
  return Timestamp(static_cast<std::int64_t>(bits & kLowBits) * kNanoseconds +
                   static_cast<std::int64_t>(bits >> 32U));
}

std::uint64_t ros1_bits(Timestamp time) {
  const auto nanoseconds = static_cast<std::uint64_t>(time.nanoseconds());
  return nanoseconds / kNanoseconds | nanoseconds % kNanoseconds << 32U;
}

}  // namespace mms
