#include "mms/io/cloud/pcd_io.hpp"

#include <cstring>
#include <map>
#include <numeric>

#include "mms/core/error.hpp"
#include "mms/io/cloud/lzf.hpp"
#include "mms/io/cloud/point_record.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/text/header_text.hpp"

namespace mms {
namespace {

const std::map<std::string, ScalarType> kPcdTypes = {
    {"I1", ScalarType::kInt8},    {"U1", ScalarType::kUint8},   {"I2", ScalarType::kInt16},
    {"U2", ScalarType::kUint16},  {"I4", ScalarType::kInt32},   {"U4", ScalarType::kUint32},
    {"F4", ScalarType::kFloat32}, {"F8", ScalarType::kFloat64}, {"I8", ScalarType::kInt64},
    {"U8", ScalarType::kUint64}};

const std::map<std::string, Channel> kPcdChannels = {{"x", Channel::kX},
                                                     {"y", Channel::kY},
                                                     {"z", Channel::kZ},
                                                     {"normal_x", Channel::kNormalX},
                                                     {"normal_y", Channel::kNormalY},
                                                     {"normal_z", Channel::kNormalZ},
                                                     {"rgb", Channel::kPackedRgb},
                                                     {"label", Channel::kLabel},
                                                     {"intensity", Channel::kIntensity},
                                                     {"time", Channel::kTime},
                                                     {"observations", Channel::kObservations}};

/// Header lines by keyword, up to and including DATA.
using PcdHeader = std::map<std::string, std::vector<std::string>>;

PcdHeader read_pcd_header(HeaderText& header) {
  PcdHeader lines;
  while (!lines.contains("DATA")) {
    std::vector<std::string> words = header.next_line();
    const std::string key = words.front();
    words.erase(words.begin());
    if (!lines.emplace(key, std::move(words)).second) header.fail(key + " appears twice");
  }
  for (const char* key : {"FIELDS", "SIZE", "TYPE", "POINTS"}) {
    if (!lines.contains(key)) header.fail(std::string("is not a PCD header: missing ") + key);
  }
  return lines;
}

PointRecord read_record(const HeaderText& header, PcdHeader& lines) {
  constexpr std::uint64_t kMaxColumns = 4096;
  const std::vector<std::string>& fields = lines["FIELDS"];
  const std::vector<std::string>& sizes = lines["SIZE"];
  const std::vector<std::string>& types = lines["TYPE"];
  std::vector<std::string>& counts = lines["COUNT"];
  if (counts.empty()) counts.assign(fields.size(), "1");
  if (sizes.size() != fields.size() || types.size() != fields.size() ||
      counts.size() != fields.size()) {
    header.fail("FIELDS, SIZE, TYPE and COUNT differ in length");
  }
  PointRecord record;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const auto type = kPcdTypes.find(types[i] + sizes[i]);
    if (type == kPcdTypes.end()) header.fail("unknown TYPE and SIZE '" + types[i] + sizes[i] + "'");
    const auto known = kPcdChannels.find(fields[i]);
    const std::uint64_t count = header.count(counts[i]);
    if (count > kMaxColumns) header.fail("COUNT is " + counts[i] + ", allowed: up to 4096");
    const bool single = known != kPcdChannels.end() && count == 1;
    record.insert(record.end(), count, {single ? known->second : Channel::kOther, type->second});
    names.insert(names.end(), count, count == 1 ? fields[i] : "");
  }
  find_lidar_columns(record, names);
  check_record(record, header.where());
  return record;
}

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

/// The points of binary_compressed data: two sizes, then all values of the first field, those of
/// the second and so on, compressed.
/// @param widths  of the fields of a point [B]
std::string decompressed(std::string_view data, std::uint64_t count,
                         const std::vector<std::size_t>& widths, const std::string& where) {
  constexpr std::size_t kSizes = 2 * sizeof(std::uint32_t);
  const std::size_t stride = std::accumulate(widths.begin(), widths.end(), std::size_t{0});
  const auto fail = [&](const std::string& what) {
    throw DataError(where, "its compressed data " + what, "the file may be truncated or damaged");
  };
  if (data.size() < kSizes) fail("are missing");
  const std::size_t compressed = word_at(data, 0);
  const std::size_t size = word_at(data, sizeof(std::uint32_t));
  if (compressed > data.size() - kSizes) {
    fail("have " + std::to_string(data.size() - kSizes) + " bytes of " +
         std::to_string(compressed));
  }
  if (size / stride != count || size % stride != 0) {
    fail("have " + std::to_string(size) + " bytes for " + std::to_string(count) + " points of " +
         std::to_string(stride));
  }
  constexpr std::size_t kMaxSmall = std::size_t{64} << 20U;  // [B]
  constexpr std::size_t kMaxRatio = 32;                      // clouds are compressed by 2 to 4
  if (size > kMaxSmall + kMaxRatio * compressed) {
    fail("would have " + std::to_string(size) + " bytes, more than " + std::to_string(kMaxRatio) +
         " times as many");
  }
  const auto columns = decompress_lzf(data.substr(kSizes, compressed), size);
  if (!columns) fail("cannot be decompressed");
  std::string points(size, '\0');
  std::size_t offset = 0;
  const char* from = columns->data();
  for (const std::size_t width : widths) {
    for (std::size_t i = 0; i < count; ++i, from += width) {
      std::memcpy(points.data() + i * stride + offset, from, width);
    }
    offset += width;
  }
  return points;
}

std::string_view pcd_name(Channel channel) {
  for (const auto& [name, known] : kPcdChannels) {
    if (known == channel) return name;
  }
  return "";
}

}  // namespace

PointCloudFile read_pcd(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  HeaderText text(bytes, path.string());
  PcdHeader lines = read_pcd_header(text);
  const PointRecord record = read_record(text, lines);
  const auto word = [&](const std::string& key) { return lines[key].empty() ? "" : lines[key][0]; };
  const std::string data = word("DATA");
  const std::uint64_t count = text.count(word("POINTS"));
  if (data == "ascii") return decode_ascii(text.rest(), count, record, path.string());
  if (data == "binary") return decode_binary(text.rest(), count, record, path.string());
  if (data == "binary_compressed") {
    std::vector<std::size_t> widths;
    for (std::size_t i = 0; i < lines["SIZE"].size(); ++i) {
      widths.push_back(text.count(lines["SIZE"][i]) * text.count(lines["COUNT"][i]));
    }
    return decode_binary(decompressed(text.rest(), count, widths, path.string()), count, record,
                         path.string());
  }
  text.fail("unsupported DATA '" + data + "'", "supported: ascii, binary, binary_compressed");
}

void write_pcd(const std::filesystem::path& path, const PointCloudFile& cloud) {
  const PointRecord record = record_of(cloud, true);
  std::string fields = "FIELDS";
  std::string sizes = "SIZE";
  std::string types = "TYPE";
  std::string counts = "COUNT";
  for (const PointColumn& column : record) {
    fields.append(" ").append(pcd_name(column.channel));
    sizes += " 4";
    types += column.type == ScalarType::kFloat32 ? " F" : " I";
    counts += " 1";
  }
  const std::string points = std::to_string(cloud.points.size());
  AtomicFile file(path);
  file.stream() << "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"
                << fields << '\n'
                << sizes << '\n'
                << types << '\n'
                << counts << "\nWIDTH " << points << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS "
                << points << "\nDATA binary\n"
                << encode_binary(cloud, record);
  file.commit();
}

}  // namespace mms
