#include "mms/ros/storage/ros1_writer.hpp"

#include <algorithm>

#include "mms/ros/storage/ros1_records.hpp"

namespace mms {
namespace {

/// Records in a chunk, after which it is closed [B]; rosbag has the same.
constexpr std::size_t kRos1ChunkSize = std::size_t{768} << 10U;

/// Named values of a record in alphabetical order, as rosbag writes them.
class Header {
 public:
  explicit Header(Ros1Op op) { add("op", op); }
  Header() = default;

  template <class T>
  Header& add(const std::string& name, T value) {
    std::string bytes;
    append_bytes(bytes, value);
    return text(name, bytes);
  }
  Header& text(const std::string& name, const std::string& value) {
    values_[name] = value;
    return *this;
  }

  std::string bytes() const {
    std::string bytes;
    for (const auto& [name, value] : values_) {
      append_bytes(bytes, static_cast<std::uint32_t>(name.size() + 1 + value.size()));
      bytes.append(name).append("=").append(value);
    }
    return bytes;
  }

 private:
  std::map<std::string, std::string> values_;
};

void append_block(std::string& bytes, std::string_view block) {
  append_bytes(bytes, static_cast<std::uint32_t>(block.size()));
  bytes.append(block);
}

std::string ros1_record(const Header& header, std::string_view data) {
  std::string bytes;
  append_block(bytes, header.bytes());
  append_block(bytes, data);
  return bytes;
}

}  // namespace

Ros1Writer::Ros1Writer(const std::filesystem::path& path)
    : BagWriter(msg::WireFormat::kRos1), file_(path) {
  append(kRos1Magic);
  write_bag_header(0);
}

void Ros1Writer::append(std::string_view bytes) {
  file_.write(bytes);
  position_ += bytes.size();
}

void Ros1Writer::write_bag_header(std::uint64_t index_position) {
  constexpr std::size_t kSize = 4096;  // with padding, to be written again at the end [B]
  const Header header = Header(Ros1Op::kBagHeader)
                            .add("index_pos", index_position)
                            .add("conn_count", static_cast<std::uint32_t>(connections_.size()))
                            .add("chunk_count", static_cast<std::uint32_t>(chunk_infos_.size()));
  append(ros1_record(header, std::string(kSize - header.bytes().size(), ' ')));
}

void Ros1Writer::write_bytes(const std::string& topic, Timestamp recorded,
                             const msg::MessageType& type, std::string_view bytes) {
  // Bags must not contain time zero.
  const Timestamp time = std::max(recorded, Timestamp(1));
  const auto [entry, is_new] =
      connection_of_topic_.emplace(topic, static_cast<std::uint32_t>(connection_of_topic_.size()));
  const std::uint32_t connection = entry->second;
  if (is_new) {
    const Header description = Header()
                                   .text("type", type.name)
                                   .text("md5sum", type.md5)
                                   .text("message_definition", type.definition);
    connections_.push_back(
        ros1_record(Header(Ros1Op::kConnection).add("conn", connection).text("topic", topic),
                    description.bytes()));
    chunk_ += connections_.back();
  }
  index_[connection].push_back({time, static_cast<std::uint32_t>(chunk_.size())});
  chunk_ += ros1_record(
      Header(Ros1Op::kMessage).add("conn", connection).add("time", ros1_bits(time)), bytes);
  if (chunk_.size() > kRos1ChunkSize) finish_chunk();
}

void Ros1Writer::finish_chunk() {
  if (chunk_.empty()) return;
  const std::uint64_t start = position_;
  append(ros1_record(Header(Ros1Op::kChunk)
                         .text("compression", "none")
                         .add("size", static_cast<std::uint32_t>(chunk_.size())),
                     chunk_));
  Timestamp first = index_.begin()->second.front().time;
  Timestamp last = first;
  std::string counts;
  for (auto& [connection, entries] : index_) {
    std::stable_sort(entries.begin(), entries.end(),
                     [](const Entry& a, const Entry& b) { return a.time < b.time; });
    std::string data;
    for (const Entry& entry : entries) {
      append_bytes(data, ros1_bits(entry.time));
      append_bytes(data, entry.offset);
    }
    const auto count = static_cast<std::uint32_t>(entries.size());
    append(ros1_record(Header(Ros1Op::kIndex)
                           .add("ver", std::uint32_t{1})
                           .add("conn", connection)
                           .add("count", count),
                       data));
    first = std::min(first, entries.front().time);
    last = std::max(last, entries.back().time);
    append_bytes(counts, connection);
    append_bytes(counts, count);
  }
  chunk_infos_.push_back(ros1_record(Header(Ros1Op::kChunkInfo)
                                         .add("ver", std::uint32_t{1})
                                         .add("chunk_pos", start)
                                         .add("start_time", ros1_bits(first))
                                         .add("end_time", ros1_bits(last))
                                         .add("count", static_cast<std::uint32_t>(index_.size())),
                                     counts));
  chunk_.clear();
  index_.clear();
}

void Ros1Writer::finish() {
  finish_chunk();
  const std::uint64_t index_position = position_;
  for (const std::string& record : connections_) append(record);
  for (const std::string& record : chunk_infos_) append(record);
  file_.stream().seekp(static_cast<std::streamoff>(kRos1Magic.size()));
  write_bag_header(index_position);
  file_.commit();
}

}  // namespace mms
