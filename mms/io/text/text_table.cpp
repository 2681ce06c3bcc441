#include "mms/io/text/text_table.hpp"

#include "mms/core/error.hpp"
#include "mms/io/text/files.hpp"

namespace mms {
namespace {

constexpr std::string_view kSeparators = " \t,\r";
constexpr std::uint64_t kMaxTextSize = std::uint64_t{2} << 30U;  // [B]: 20 h of EuRoC's IMU
constexpr std::size_t kMaxColumns = 1000;                        // of a line
constexpr std::size_t kMaxFields = 100'000'000;                  // of all lines

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> fields;
  std::size_t begin = line.find_first_not_of(kSeparators);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(kSeparators, begin), line.size());
    if (fields.size() == kMaxColumns + 1) break;
    fields.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kSeparators, end);
  }
  return fields;
}

}  // namespace

TextTable::TextTable(const std::filesystem::path& path)
    : file_(path.string()), text_(read_file(path, kMaxTextSize)) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  std::string_view rest = text_;
  if (rest.starts_with(kByteOrderMark)) rest.remove_prefix(kByteOrderMark.size());
  std::size_t count = 0;
  for (int number = 1; !rest.empty(); ++number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    std::vector<std::string_view> fields = split(rest.substr(0, end));
    count += fields.size();
    if (fields.size() > kMaxColumns || count > kMaxFields) {
      throw DataError(file_ + ":" + std::to_string(number),
                      "a text file has up to " + std::to_string(kMaxColumns) + " columns and " +
                          std::to_string(kMaxFields) + " fields",
                      "it may be a file of another kind");
    }
    const bool is_comment = !fields.empty() && fields.front().starts_with('#');
    if (is_comment && number == 1) {
      fields.front().remove_prefix(1);
      header_ = std::move(fields);
    } else if (!is_comment && !fields.empty()) {
      lines_.push_back({number, std::move(fields)});
    }
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
}

std::vector<std::string_view> TextTable::fields() const {
  std::vector<std::string_view> fields;
  for (const TextLine& line : lines_) {
    fields.insert(fields.end(), line.fields.begin(), line.fields.end());
  }
  return fields;
}

std::string TextTable::where(const TextLine& line) const {
  return file_ + ":" + std::to_string(line.number);
}

}  // namespace mms
