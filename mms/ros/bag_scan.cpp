#include "mms/ros/bag_scan.hpp"

#include <cstdint>
#include <fstream>
#include <map>
#include <optional>

#include "mms/core/error.hpp"
#include "mms/io/journal/byte_reader.hpp"

namespace mms {

std::string listed(const std::vector<BagTopic>& topics) {
  std::string text;
  for (const BagTopic& topic : topics) {
    text += (text.empty() ? "" : ", ") + topic.name + " " + topic.type + " (" +
            std::to_string(topic.count) + ")";
  }
  return text.empty() ? "no topics" : text;
}

namespace {

constexpr std::string_view kMagic = "#ROSBAG V2.0\n";
constexpr char kMessage = 0x02;
constexpr char kChunk = 0x05;
constexpr char kConnection = 0x07;

using Fields = std::map<std::string, std::string_view, std::less<>>;

/// "name=value" fields, each preceded by its length.
Fields parse_fields(std::string_view bytes) {
  ByteReader reader(bytes, "record");
  Fields fields;
  while (reader.left() > 0) {
    const std::string_view field = reader.take(reader.take_count(1));
    const std::size_t equals = field.find('=');
    if (equals == std::string_view::npos) throw DataError("record", "has an unnamed field");
    fields.emplace(field.substr(0, equals), field.substr(equals + 1));
  }
  return fields;
}

std::string_view field_of(const Fields& fields, std::string_view name) {
  const auto found = fields.find(name);
  return found == fields.end() ? std::string_view() : found->second;
}

std::uint32_t number_of(const Fields& fields, std::string_view name) {
  return ByteReader(field_of(fields, name), "record").take<std::uint32_t>();
}

/// Collects the connections and counts their messages.
class Inventory {
 public:
  /// Adds one record.
  /// @throws DataError if it is damaged.
  void add(const Fields& fields, std::string_view data) {
    const std::string_view op = field_of(fields, "op");
    if (op.size() != 1) throw DataError("record", "has no operation");
    if (op[0] == kMessage) ++counts_[number_of(fields, "conn")];
    if (op[0] == kConnection) {
      const std::string_view type = field_of(parse_fields(data), "type");
      connections_[number_of(fields, "conn")] = {std::string(field_of(fields, "topic")),
                                                 std::string(type), 0};
    }
    if (op[0] == kChunk) add_chunk(fields, data);
  }

  bool compressed() const { return compressed_; }

  std::vector<BagTopic> topics() const {
    std::map<std::string, BagTopic> by_name;  // several nodes may publish a topic
    for (const auto& [id, connection] : connections_) {
      BagTopic& topic = by_name.emplace(connection.name, connection).first->second;
      const auto count = counts_.find(id);
      if (count != counts_.end()) topic.count += count->second;
    }
    std::vector<BagTopic> topics;
    for (auto& [name, topic] : by_name) topics.push_back(std::move(topic));
    return topics;
  }

 private:
  void add_chunk(const Fields& fields, std::string_view data) {
    if (field_of(fields, "compression") != "none") {
      compressed_ = true;
      return;
    }
    ByteReader reader(data, "chunk");
    while (reader.left() > 0) {
      const Fields inner = parse_fields(reader.take(reader.take_count(1)));
      add(inner, reader.take(reader.take_count(1)));
    }
  }

  std::map<std::uint32_t, BagTopic> connections_;
  std::map<std::uint32_t, std::size_t> counts_;
  bool compressed_ = false;
};

/// The next length-prefixed block of a file; nullopt if the file ends before.
std::optional<std::string> take_block(std::ifstream& file, std::uint64_t left) {
  std::uint32_t size = 0;
  if (left < sizeof size || !file.read(reinterpret_cast<char*>(&size), sizeof size)) return {};
  std::string bytes;
  if (size > left - sizeof size) {  // the available part
    bytes.resize(left - sizeof size);
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.setstate(std::ios::failbit);
    return bytes;
  }
  bytes.resize(size);
  if (!file.read(bytes.data(), size)) return {};
  return bytes;
}

}  // namespace

BagScan scan_bag(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(path.string(), "cannot be read");
  const std::uint64_t size = std::filesystem::file_size(path);
  std::string magic(kMagic.size(), '\0');
  file.read(magic.data(), static_cast<std::streamsize>(magic.size()));
  BagScan scan;
  scan.is_bag = file && magic == kMagic;
  Inventory inventory;
  try {
    while (scan.is_bag && static_cast<std::uint64_t>(file.tellg()) < size) {
      const auto left = [&] { return size - static_cast<std::uint64_t>(file.tellg()); };
      const auto header = take_block(file, left());
      if (!header || !file) throw DataError(path.string(), "ends within a record");
      const Fields fields = parse_fields(*header);
      const auto data = take_block(file, left());
      if (!data) throw DataError(path.string(), "ends within a record");
      scan.truncated = !file;
      inventory.add(fields, *data);
    }
  } catch (const DataError&) {
    scan.truncated = true;
  }
  scan.compressed = inventory.compressed();
  scan.topics = inventory.topics();
  return scan;
}

}  // namespace mms
