#include "mms/dataset/lidar/scan_layout.hpp"

#include <algorithm>
#include <numeric>
#include <string_view>

#include "mms/core/error.hpp"
#include "mms/dataset/source/folder_names.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

struct KnownLayout {
  const char* name = "";
  ScanDataset dataset = ScanDataset::kOther;
  const char* folder = "";  ///< of the scans, in the recording's
  const char* ending = "";
  ScanFormat format{};
};

using Kind = ScanFormat::Kind;
constexpr ScanFormat kFloats{};
constexpr ScanFormat kMulRan{.has_columns = true};
constexpr ScanFormat kNclt{.kind = Kind::kNclt};
constexpr ScanFormat kCloudFile{.kind = Kind::kCloudFile};
constexpr ScanFormat kNewerCollege{.kind = Kind::kCloudFile, .has_columns = true};

/// The first one with scans counts.
constexpr KnownLayout kLayouts[] = {
    {"KITTI raw", ScanDataset::kKittiRaw, "velodyne_points/data", ".bin", kFloats},
    {"MulRan", ScanDataset::kMulRan, "Ouster", ".bin", kMulRan},
    {"MulRan", ScanDataset::kMulRan, "sensor_data/Ouster", ".bin", kMulRan},
    {"NCLT", ScanDataset::kNclt, "velodyne_sync", ".bin", kNclt},
    {"Newer College", ScanDataset::kNewerCollege, "raw_format/ouster_scan", ".pcd", kNewerCollege},
    {"Newer College", ScanDataset::kNewerCollege, "ouster_scan", ".pcd", kNewerCollege},
    {"KITTI LiDAR scans", ScanDataset::kKitti, "", ".bin", kFloats},
    {"KITTI LiDAR scans", ScanDataset::kKitti, "velodyne", ".bin", kFloats},
    {"PCD files", ScanDataset::kOther, "", ".pcd", kCloudFile},
    {"PLY files", ScanDataset::kOther, "", ".ply", kCloudFile}};

/// Records of HeLiPR's sensors, in folders of their names.
struct HeLiPRSensor {
  const char* name = "";
  ScanFormat format;
};
constexpr HeLiPRSensor kHeLiPRSensors[] = {
    {"Ouster",
     {.kind = Kind::kRecords, .bytes = 26, .time = PointTime::kIntegerNanoseconds, .time_at = 16}},
    {"Velodyne",
     {.kind = Kind::kRecords, .bytes = 22, .time = PointTime::kFloatSeconds, .time_at = 18}},
    {"Avia",
     {.kind = Kind::kRecords,
      .bytes = 19,
      .has_intensity = false,
      .time = PointTime::kIntegerNanoseconds,
      .time_at = 15}},
    {"Aeva",
     {.kind = Kind::kRecords, .bytes = 29, .time = PointTime::kIntegerNanoseconds, .time_at = 20}}};

/// Until this stamp, records of the Aeva end before the last float32, an intensity besides the
/// reflectivity.
constexpr std::int64_t kLastShortAeva = 1'691'936'557'946'849'179;  // [ns]
constexpr std::size_t kShortAevaBytes = 25;

ScanFormat format_of(const HeLiPRSensor& sensor, const fs::path& scan) {
  ScanFormat format = sensor.format;
  const auto stamp = parse_integer(scan.stem().string());
  if (sensor.name == std::string_view("Aeva") && stamp && *stamp <= kLastShortAeva) {
    format.bytes = kShortAevaBytes;
  }
  return format;
}

/// @param folder  of the scans
const HeLiPRSensor* helipr_sensor(const fs::path& folder) {
  const fs::path whole = absolute_folder(folder);
  if (whole.parent_path().filename() != "LiDAR") return nullptr;
  const auto* found =
      std::find_if(std::begin(kHeLiPRSensors), std::end(kHeLiPRSensors),
                   [&](const HeLiPRSensor& sensor) { return whole.filename() == sensor.name; });
  return found == std::end(kHeLiPRSensors) ? nullptr : found;
}

/// Maps and truth clouds are .pcd and .ply, too; the names of scans end with a number.
bool is_scan(std::string_view name, std::string_view ending) {
  if (!name.ends_with(ending) || name.size() == ending.size()) return false;
  const char last = name[name.size() - ending.size() - 1];
  return ending == ".bin" || (last >= '0' && last <= '9');
}

/// A run of digits at the beginning of a text, without leading zeros; the rest begins after it.
std::string_view take_number(std::string_view& text) {
  const auto end = std::min(text.find_first_not_of("0123456789"), text.size());
  std::string_view digits = text.substr(0, end);
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
  text.remove_prefix(end);
  return digits;
}

bool begins_with_digit(std::string_view text) {
  return !text.empty() && text.front() >= '0' && text.front() <= '9';
}

/// Order of names with numbers of different length: 2.pcd before 10.pcd.
bool numeric_order(std::string_view a, std::string_view b) {
  while (!a.empty() && !b.empty()) {
    if (begins_with_digit(a) && begins_with_digit(b)) {
      const std::string_view first = take_number(a);
      const std::string_view second = take_number(b);
      if (first.size() != second.size()) return first.size() < second.size();
      if (first != second) return first < second;
      continue;
    }
    if (a.front() != b.front()) return a.front() < b.front();
    a.remove_prefix(1);
    b.remove_prefix(1);
  }
  return a.size() < b.size();
}

std::vector<fs::path> scans_in(const fs::path& folder, std::string_view ending) {
  std::vector<fs::path> scans;
  if (!fs::is_directory(folder)) return scans;
  for (const std::string& name : list_folder(folder)) {
    if (is_scan(name, ending)) scans.push_back(folder / name);
  }
  std::stable_sort(scans.begin(), scans.end(), [](const fs::path& a, const fs::path& b) {
    return numeric_order(a.filename().string(), b.filename().string());
  });
  return scans;
}

}  // namespace

bool has_scans(const std::vector<std::string>& names) {
  return std::any_of(std::begin(kLayouts), std::end(kLayouts), [&](const KnownLayout& layout) {
    const std::string_view folder = layout.folder;
    if (!folder.empty()) return has_name(names, folder.substr(0, folder.find('/')));
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string& name) { return is_scan(name, layout.ending); });
  });
}

ScanLayout find_scan_layout(const fs::path& folder) {
  for (const KnownLayout& known : kLayouts) {
    std::vector<fs::path> scans =
        scans_in(*known.folder == '\0' ? folder : folder / known.folder, known.ending);
    if (scans.empty()) continue;
    const HeLiPRSensor* sensor = helipr_sensor(scans.front().parent_path());
    if (sensor != nullptr) {
      const ScanFormat format = format_of(*sensor, scans.front());
      return {"HeLiPR", ScanDataset::kHeLiPR, std::move(scans), format};
    }
    return {known.name, known.dataset, std::move(scans), known.format};
  }
  throw DataError(folder.string(), "has no *.bin scans, and neither has velodyne/");
}

std::vector<std::size_t> lines_of_scans(const std::vector<fs::path>& scans, std::size_t lines) {
  std::vector<std::size_t> numbers(scans.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  if (scans.size() == lines) return numbers;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const auto number = parse_integer(scans[i].stem().string());
    if (!number || *number < 0 || static_cast<std::size_t>(*number) >= lines) return {};
    numbers[i] = static_cast<std::size_t>(*number);
  }
  return numbers;
}

}  // namespace mms
