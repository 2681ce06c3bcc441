#include "mms/dataset/source/image_list.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "mms/core/error.hpp"
#include "mms/io/text/numbers.hpp"
#include "mms/io/text/stamp_reader.hpp"
#include "mms/io/text/text_table.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

/// Faults in the lines of a list: the first of each kind and their number.
class LineFaults {
 public:
  explicit LineFaults(std::string what) : what_(std::move(what)) {}

  void add(const std::string& where) {
    if (count_++ == 0) first_ = where;
  }

  void report(std::vector<std::string>& warnings) const {
    if (count_ == 0) return;
    const std::string more = count_ == 1 ? "" : " (" + std::to_string(count_) + " such lines)";
    warnings.push_back(first_ + ": " + what_ + more);
  }

 private:
  std::string what_;
  std::string first_;
  std::size_t count_ = 0;
};

std::optional<ListedImage> parse_image(const fs::path& folder, const TextLine& line,
                                       std::size_t column, const StampReader& read_stamp) {
  const auto stamp = read_stamp(line.fields[column]);
  if (!stamp) return std::nullopt;
  return ListedImage{*stamp, folder / line.fields[column + 1]};
}

/// "depth/1.png 2 rgb/2.png": some datasets list the depth image first.
bool depth_comes_first(const TextLine& line) {
  constexpr auto kNone = std::string_view::npos;
  return line.fields[1].find("depth") != kNone && line.fields[3].find("depth") == kNone;
}

std::optional<ListedPair> parse_pair(const fs::path& folder, const TextLine& line,
                                     const StampReader& read_stamp) {
  auto first = parse_image(folder, line, 0, read_stamp);
  auto second = parse_image(folder, line, 2, read_stamp);
  if (!first || !second) return std::nullopt;
  if (depth_comes_first(line)) std::swap(first, second);
  return ListedPair{*first, *second};
}

Timestamp stamp_of(const ListedImage& image) {
  return image.stamp;
}
Timestamp stamp_of(const ListedPair& pair) {
  return pair.color.stamp;
}

/// The lines of `columns` columns that `parse` accepts, without duplicate stamps.
template <class Parse>
auto read_list(const fs::path& list, std::size_t columns, const std::string& form, Parse parse,
               std::vector<std::string>& warnings) {
  const TextTable table(list);
  const StampReader read_stamp(table, 0, kLongestImageStep);
  const fs::path folder = list.parent_path();
  LineFaults damaged("line skipped, expected '" + form + "'");
  LineFaults duplicate("line skipped, duplicate stamp");
  std::vector<typename decltype(parse(folder, table.lines()[0], read_stamp))::value_type> entries;
  std::set<Timestamp> seen;
  for (const TextLine& line : table.lines()) {
    const auto entry =
        line.fields.size() == columns ? parse(folder, line, read_stamp) : std::nullopt;
    if (!entry) {
      damaged.add(table.where(line));
    } else if (!seen.insert(stamp_of(*entry)).second) {
      duplicate.add(table.where(line));
    } else {
      entries.push_back(*entry);
    }
  }
  if (entries.empty()) {
    throw DataError(list.string(), "lists no images", "expected lines of '" + form + "'");
  }
  damaged.report(warnings);
  duplicate.report(warnings);
  return entries;
}

}  // namespace

std::vector<ListedImage> read_image_list(const fs::path& list, std::vector<std::string>& warnings,
                                         const fs::path& below) {
  const auto parse = [&below](const fs::path& folder, const TextLine& line,
                              const StampReader& read_stamp) {
    return parse_image(below.empty() ? folder : folder / below, line, 0, read_stamp);
  };
  return read_list(list, 2, "stamp path", parse, warnings);
}

bool has_whole_stamps(const fs::path& list) {
  const TextTable table(list);
  return std::all_of(table.lines().begin(), table.lines().end(), [](const TextLine& line) {
    return parse_integer(line.fields[0]).has_value();
  });
}

std::vector<ListedPair> read_associations(const fs::path& list,
                                          std::vector<std::string>& warnings) {
  return read_list(list, 4, "stamp path stamp path", parse_pair, warnings);
}

}  // namespace mms
