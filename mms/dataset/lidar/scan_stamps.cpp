#include "mms/dataset/lidar/scan_stamps.hpp"

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>

#include "mms/core/error.hpp"
#include "mms/dataset/source/assumed_stamp.hpp"
#include "mms/io/text/numbers.hpp"
#include "mms/io/text/stamp_reader.hpp"
#include "mms/io/text/text_table.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;        // [ns]
constexpr std::int64_t kFirstSecond = 1'000'000'000;   // in 2001
constexpr std::int64_t kEndSecond = 9 * kFirstSecond;  // in 2255

/// The digits at the end of a text.
std::string_view last_digits(std::string_view text) {
  std::size_t begin = text.size();
  while (begin > 0 && text[begin - 1] >= '0' && text[begin - 1] <= '9') --begin;
  return text.substr(begin);
}

/// Name of a scan without its endings.
std::string name_of(const fs::path& scan) {
  std::string name = scan.stem().string();
  if (name.ends_with(".pcd")) name.resize(name.size() - 4);
  return name;
}

/// Stamps in names that are nanoseconds since the sensor was turned on; empty for others.
std::vector<Timestamp> start_stamps_in_names(const std::vector<fs::path>& scans) {
  std::vector<std::int64_t> numbers;
  std::vector<Timestamp> stamps;
  for (const fs::path& scan : scans) {
    const std::string name = name_of(scan);
    const auto number = parse_integer(last_digits(name));
    if (!number || *number < kSecond) return {};  // a count, or nanoseconds after seconds
    numbers.push_back(*number);
    stamps.emplace_back(*number);
  }
  if (!are_nanoseconds_since_start(std::move(numbers), kLongestImageStep)) return {};
  return stamps;
}

/// Seconds with decimals at the end of a name, as in 1710252326.122305000.
std::optional<Timestamp> decimal_stamp(std::string_view text, std::string_view decimals) {
  const std::size_t dot = text.size() - decimals.size() - 1;
  const std::string_view whole = last_digits(text.substr(0, dot));
  const auto seconds = parse_integer(whole);
  if (!seconds || *seconds < kFirstSecond || *seconds >= kEndSecond) return std::nullopt;
  return parse_stamp(text.substr(dot - whole.size()));
}

/// Stamp in a name, as in N008__LIDAR_TOP__1532402927647951.pcd.bin.
std::optional<Timestamp> stamp_in_name(const fs::path& scan) {
  const std::string name = name_of(scan);
  const std::string_view text = name;
  const std::string_view digits = last_digits(text);
  const auto number = parse_integer(digits);
  if (!number) return std::nullopt;
  if (text.substr(0, text.size() - digits.size()).ends_with(".")) {
    if (const auto stamp = decimal_stamp(text, digits)) return stamp;
  }
  if (const auto stamp = stamp_of_number(*number)) return stamp;
  if (!text.substr(0, text.size() - digits.size()).ends_with("_")) return std::nullopt;
  const auto before = last_digits(text.substr(0, text.size() - digits.size() - 1));
  const auto seconds = parse_integer(before);
  if (!seconds || *seconds < kFirstSecond || *seconds >= kEndSecond || *number >= kSecond) {
    return std::nullopt;
  }
  return Timestamp(*seconds * kSecond + *number);
}

std::vector<Timestamp> stamps_in_names(const std::vector<fs::path>& scans) {
  std::vector<Timestamp> stamps = start_stamps_in_names(scans);
  if (!stamps.empty()) return stamps;
  for (const fs::path& scan : scans) {
    const auto stamp = stamp_in_name(scan);
    if (!stamp) return {};
    stamps.push_back(*stamp);
  }
  return stamps;
}

std::vector<Timestamp> read_times(const fs::path& file, const std::vector<fs::path>& scans) {
  std::vector<Timestamp> stamps;
  const TextTable table(file);
  const StampReader read_stamp(table, 0, kLongestImageStep);
  for (const TextLine& line : table.lines()) {
    const auto stamp = read_stamp(line.fields[0]);
    if (!stamp) throw DataError(table.where(line), "is not a stamp in seconds");
    stamps.push_back(*stamp);
  }
  const std::vector<std::size_t> lines = lines_of_scans(scans, stamps.size());
  if (lines.empty()) {
    throw DataError(file.string(), "has " + std::to_string(stamps.size()) + " stamps for " +
                                       std::to_string(scans.size()) + " scans");
  }
  std::vector<Timestamp> chosen;
  for (const std::size_t line : lines) chosen.push_back(stamps[line]);
  return chosen;
}

/// Parses "2011-09-26" and "13:02:25.951199337" as UTC.
std::optional<Timestamp> parse_date(std::string_view date, std::string_view time) {
  if (date.size() != 10 || time.size() < 8) return std::nullopt;
  const auto year = parse_integer(date.substr(0, 4));
  const auto month = parse_integer(date.substr(5, 2));
  const auto day = parse_integer(date.substr(8, 2));
  const auto hour = parse_integer(time.substr(0, 2));
  const auto minute = parse_integer(time.substr(3, 2));
  const auto second = parse_stamp(time.substr(6));
  if (!year || !month || !day || !hour || !minute || !second) return std::nullopt;
  const std::chrono::year_month_day when{std::chrono::year(static_cast<int>(*year)),
                                         std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day))};
  if (!when.ok()) return std::nullopt;
  const std::int64_t days = std::chrono::sys_days(when).time_since_epoch().count();
  return Timestamp(((days * 24 + *hour) * 60 + *minute) * 60 * kSecond + second->nanoseconds());
}

/// Line i of the file is that of scan number i. Where a scan is missing, its line may be empty.
std::vector<Timestamp> read_kitti_raw(const fs::path& file, const std::vector<fs::path>& scans) {
  const TextTable table(file);
  std::map<std::int64_t, const TextLine*> lines;  // by number of the scan
  for (const TextLine& line : table.lines()) lines.emplace(line.number - 1, &line);
  std::vector<Timestamp> stamps;
  for (const fs::path& scan : scans) {
    const auto number = parse_integer(scan.stem().string());
    const auto found = number ? lines.find(*number) : lines.end();
    if (found == lines.end()) {
      throw DataError(file.string(), "has no line for scan " + scan.filename().string());
    }
    const TextLine& line = *found->second;
    const auto stamp =
        line.fields.size() == 2 ? parse_date(line.fields[0], line.fields[1]) : std::nullopt;
    if (!stamp) throw DataError(table.where(line), "is not a date and a time");
    stamps.push_back(*stamp);
  }
  return stamps;
}

}  // namespace

ScanStamps read_scan_stamps(const fs::path& folder, const ScanLayout& layout,
                            std::vector<std::string>& facts) {
  const fs::path times = folder / "times.txt";
  if (fs::exists(times)) {
    facts.emplace_back("stamps: times.txt");
    return {read_times(times, layout.scans), std::nullopt};
  }
  const fs::path raw = folder / "velodyne_points" / "timestamps.txt";
  if (layout.dataset == ScanDataset::kKittiRaw && fs::exists(raw)) {
    facts.emplace_back("stamps: velodyne_points/timestamps.txt");
    return {read_kitti_raw(raw, layout.scans), std::nullopt};
  }
  std::vector<Timestamp> stamps = stamps_in_names(layout.scans);
  if (!stamps.empty()) {
    facts.emplace_back("stamps: names of the scans");
    return {std::move(stamps), std::nullopt};
  }
  for (std::size_t i = 0; i < layout.scans.size(); ++i) {
    stamps.push_back(assumed_stamp(static_cast<std::int64_t>(i), kScanRate));
  }
  return {std::move(stamps), kScanRate};
}

}  // namespace mms
