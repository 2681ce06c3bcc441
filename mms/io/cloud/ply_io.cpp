#include "mms/io/cloud/ply_io.hpp"

#include <map>

#include "mms/core/error.hpp"
#include "mms/io/cloud/point_record.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/text/header_text.hpp"

namespace mms {
namespace {

const std::map<std::string, ScalarType> kPlyTypes = {
    {"char", ScalarType::kInt8},      {"int8", ScalarType::kInt8},
    {"uchar", ScalarType::kUint8},    {"uint8", ScalarType::kUint8},
    {"short", ScalarType::kInt16},    {"int16", ScalarType::kInt16},
    {"ushort", ScalarType::kUint16},  {"uint16", ScalarType::kUint16},
    {"int", ScalarType::kInt32},      {"int32", ScalarType::kInt32},
    {"uint", ScalarType::kUint32},    {"uint32", ScalarType::kUint32},
    {"float", ScalarType::kFloat32},  {"float32", ScalarType::kFloat32},
    {"double", ScalarType::kFloat64}, {"float64", ScalarType::kFloat64}};

const std::map<std::string, Channel> kPlyChannels = {{"x", Channel::kX},
                                                     {"y", Channel::kY},
                                                     {"z", Channel::kZ},
                                                     {"nx", Channel::kNormalX},
                                                     {"ny", Channel::kNormalY},
                                                     {"nz", Channel::kNormalZ},
                                                     {"red", Channel::kRed},
                                                     {"green", Channel::kGreen},
                                                     {"blue", Channel::kBlue},
                                                     {"label", Channel::kLabel},
                                                     {"intensity", Channel::kIntensity},
                                                     {"time", Channel::kTime},
                                                     {"observations", Channel::kObservations}};

struct PlyHeader {
  bool ascii = false;
  std::uint64_t vertices = 0;
  PointRecord record;
};

bool read_format(HeaderText& header) {
  if (header.next_line() != std::vector<std::string>{"ply"}) {
    header.fail("is not a PLY file", "its first line is not 'ply'");
  }
  const std::vector<std::string> words = header.next_line();
  const std::string format = words.size() == 3 && words[0] == "format" ? words[1] : "";
  if (format != "ascii" && format != "binary_little_endian") {
    header.fail("unsupported PLY format '" + format + "'",
                "supported: ascii, binary_little_endian");
  }
  return format == "ascii";
}

PointColumn read_property(const HeaderText& header, const std::vector<std::string>& words) {
  if (words.size() > 1 && words[1] == "list")
    header.fail("list properties of vertices are not supported");
  if (words.size() != 3) header.fail("expected 'property TYPE NAME'");
  const auto type = kPlyTypes.find(words[1]);
  if (type == kPlyTypes.end()) header.fail("unknown property type '" + words[1] + "'");
  const auto channel = kPlyChannels.find(words[2]);
  return {channel == kPlyChannels.end() ? Channel::kOther : channel->second, type->second};
}

/// Ignores elements after the vertices (faces). Elements before the vertices are not supported; no
/// known program writes them.
PlyHeader read_ply_header(HeaderText& header) {
  PlyHeader result;
  result.ascii = read_format(header);
  std::string element;
  std::vector<std::string> names;
  for (auto words = header.next_line(); words[0] != "end_header"; words = header.next_line()) {
    if (words[0] == "element") {
      if (words.size() != 3) header.fail("expected 'element NAME COUNT'");
      if (element.empty() && words[1] != "vertex") header.fail("the first element is not 'vertex'");
      if (!element.empty() && words[1] == "vertex") header.fail("element vertex appears twice");
      element = words[1];
      if (element == "vertex") result.vertices = header.count(words[2]);
    } else if (words[0] != "property" || element.empty()) {
      header.fail("unexpected '" + words[0] + "' in the header");
    } else if (element == "vertex") {
      result.record.push_back(read_property(header, words));
      names.push_back(words[2]);
    }
  }
  find_lidar_columns(result.record, names);
  check_record(result.record, header.where());
  return result;
}

std::string_view ply_name(Channel channel) {
  for (const auto& [name, known] : kPlyChannels) {
    if (known == channel) return name;
  }
  return "";
}

std::string_view ply_name(ScalarType type) {
  if (type == ScalarType::kFloat32) return "float";
  return type == ScalarType::kUint8 ? "uchar" : "int";
}

}  // namespace

PointCloudFile read_ply(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  HeaderText text(bytes, path.string());
  const PlyHeader header = read_ply_header(text);
  const auto decode = header.ascii ? decode_ascii : decode_binary;
  return decode(text.rest(), header.vertices, header.record, path.string());
}

void write_ply(const std::filesystem::path& path, const PointCloudFile& cloud,
               const std::vector<std::string>& comments) {
  const PointRecord record = record_of(cloud, false);
  AtomicFile file(path);
  file.stream() << "ply\nformat binary_little_endian 1.0\n";
  for (const std::string& comment : comments) file.stream() << "comment " << comment << '\n';
  file.stream() << "element vertex " << cloud.points.size() << '\n';
  for (const PointColumn& column : record) {
    file.stream() << "property " << ply_name(column.type) << ' ' << ply_name(column.channel)
                  << '\n';
  }
  file.stream() << "end_header\n" << encode_binary(cloud, record);
  file.commit();
}

}  // namespace mms
