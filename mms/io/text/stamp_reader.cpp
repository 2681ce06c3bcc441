#include "mms/io/text/stamp_reader.hpp"

#include <algorithm>
#include <string>

#include "mms/core/upper_median.hpp"

namespace mms {
namespace {

/// @param sorted  at least two numbers
std::int64_t median_step(const std::vector<std::int64_t>& sorted) {
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < sorted.size(); ++i) steps.push_back(sorted[i] - sorted[i - 1]);
  return upper_median(std::move(steps));
}

}  // namespace

bool are_nanoseconds_since_start(std::vector<std::int64_t> numbers, double longest_step) {
  constexpr std::size_t kMinNumbers = 3;
  constexpr std::int64_t kMinStep = 1'000'000;              // [ns]: 1 kHz
  constexpr std::int64_t kMaxStep = 1'000'000'000;          // [ns]: 1 Hz
  constexpr std::int64_t kEnd = 1'000'000'000'000'000'000;  // [ns]: since 1970 from here on
  if (numbers.size() < kMinNumbers) return false;
  std::sort(numbers.begin(), numbers.end());
  if (numbers.front() < 0 || numbers.back() >= kEnd) return false;
  const std::int64_t step = median_step(numbers);
  if (step < kMinStep || step > kMaxStep) return false;
  std::vector<std::int64_t> as_usual;  // [ns]
  for (const std::int64_t number : numbers) {
    const auto stamp = parse_stamp(std::to_string(number));
    if (!stamp) return true;
    as_usual.push_back(stamp->nanoseconds());
  }
  std::sort(as_usual.begin(), as_usual.end());
  return to_seconds(Duration(median_step(as_usual))) > longest_step;
}

StampReader::StampReader(const TextTable& table, std::size_t column, double longest_step) {
  std::vector<std::int64_t> numbers;
  for (const TextLine& line : table.lines()) {
    if (line.fields.size() <= column) continue;
    const std::string_view text = line.fields[column];
    if (const auto number = parse_integer(text)) {
      numbers.push_back(*number);
    } else if (parse_stamp(text)) {
      return;  // decimals are no nanoseconds
    }
  }
  since_start_ = are_nanoseconds_since_start(std::move(numbers), longest_step);
}

std::optional<Timestamp> StampReader::operator()(std::string_view text) const {
  if (!since_start_) return parse_stamp(text);
  const auto number = parse_integer(text);
  return number ? std::optional(Timestamp(*number)) : std::nullopt;
}

}  // namespace mms
