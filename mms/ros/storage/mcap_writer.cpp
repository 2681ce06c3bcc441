#include "mms/ros/storage/mcap_writer.hpp"

#include <algorithm>
#include <stdexcept>

#include "mms/io/journal/byte_reader.hpp"
#include "mms/io/journal/crc32.hpp"
#include "mms/storage/compression.hpp"

namespace mms {
namespace {

/// Records in a chunk, after which it is closed [B].
constexpr std::size_t kMcapChunkSize = std::size_t{1} << 20U;

/// Content of a record, field by field.
class Content {
 public:
  template <class T>
  Content& number(T value) {
    append_bytes(bytes, value);
    return *this;
  }
  /// Text, or a list as its bytes.
  Content& text(std::string_view value) {
    number(static_cast<std::uint32_t>(value.size()));
    bytes.append(value);
    return *this;
  }
  Content& raw(std::string_view value) {
    bytes.append(value);
    return *this;
  }

  std::string bytes;
};

std::string mcap_record(McapOp op, const Content& content) {
  std::string bytes;
  append_bytes(bytes, op);
  append_bytes(bytes, std::uint64_t{content.bytes.size()});
  return bytes + content.bytes;
}

}  // namespace

McapWriter::McapWriter(const std::filesystem::path& path)
    : BagWriter(msg::WireFormat::kCdr), file_(path) {
  append(kMcapMagic);
  append(mcap_record(McapOp::kHeader, Content().text("ros2").text("mms")));
}

void McapWriter::append(std::string_view bytes) {
  file_.write(bytes);
  position_ += bytes.size();
}

std::uint16_t McapWriter::schema_of(const msg::MessageType& type) {
  constexpr std::uint16_t kFirst = 1;  // 0 means none
  const auto number = static_cast<std::uint16_t>(kFirst + schemas_.size());
  const auto [entry, is_new] = schemas_.emplace(type.name, number);
  if (!is_new) return entry->second;
  std::string name = type.name;
  name.insert(name.find('/'), "/msg");
  const std::string record =
      mcap_record(McapOp::kSchema,
                  Content().number(number).text(name).text("ros2msg").text(type.ros2_definition));
  descriptions_ += record;
  chunk_ += record;
  return number;
}

std::uint16_t McapWriter::channel_of(const std::string& topic, const msg::MessageType& type) {
  const auto known = channels_.find(topic);
  if (known != channels_.end()) return known->second;
  const auto number = static_cast<std::uint16_t>(channels_.size());
  const std::uint16_t schema = schema_of(type);
  const std::string record = mcap_record(
      McapOp::kChannel, Content().number(number).number(schema).text(topic).text("cdr").text(""));
  descriptions_ += record;
  chunk_ += record;
  channels_.emplace(topic, number);
  return number;
}

void McapWriter::write_bytes(const std::string& topic, Timestamp recorded,
                             const msg::MessageType& type, std::string_view bytes) {
  const auto time = static_cast<std::uint64_t>(recorded.nanoseconds());
  const std::uint16_t channel = channel_of(topic, type);
  index_[channel].push_back({time, chunk_.size()});
  const auto number = static_cast<std::uint32_t>(counts_[channel]++);
  chunk_ +=
      mcap_record(McapOp::kMessage,
                  Content().number(channel).number(number).number(time).number(time).raw(bytes));
  first_time_ = std::min(first_time_, time);
  last_time_ = std::max(last_time_, time);
  if (chunk_.size() > kMcapChunkSize) finish_chunk();
}

void McapWriter::finish_chunk() {
  if (chunk_.empty()) return;
  std::uint64_t first = UINT64_MAX;
  std::uint64_t last = 0;
  for (auto& [channel, entries] : index_) {
    std::stable_sort(entries.begin(), entries.end(),
                     [](const Entry& a, const Entry& b) { return a.time < b.time; });
    first = std::min(first, entries.front().time);
    last = std::max(last, entries.back().time);
  }
  const std::string compressed = compress_zstd(chunk_);
  const std::uint64_t start = position_;
  append(mcap_record(McapOp::kChunk, Content()
                                         .number(first)
                                         .number(last)
                                         .number(std::uint64_t{chunk_.size()})
                                         .number(crc32(chunk_))
                                         .text("zstd")
                                         .number(std::uint64_t{compressed.size()})
                                         .raw(compressed)));
  const std::uint64_t indexes = position_;
  Content offsets;  // of the indexes, by channel
  for (const auto& [channel, entries] : index_) {
    offsets.number(channel).number(position_);
    Content list;
    for (const Entry& entry : entries) list.number(entry.time).number(entry.offset);
    append(mcap_record(McapOp::kMessageIndex, Content().number(channel).text(list.bytes)));
  }
  chunk_indexes_.push_back(
      mcap_record(McapOp::kChunkIndex, Content()
                                           .number(first)
                                           .number(last)
                                           .number(start)
                                           .number(indexes - start)
                                           .text(offsets.bytes)
                                           .number(position_ - indexes)
                                           .text("zstd")
                                           .number(std::uint64_t{compressed.size()})
                                           .number(std::uint64_t{chunk_.size()})));
  chunk_.clear();
  index_.clear();
}

std::string McapWriter::statistics() const {
  std::uint64_t all = 0;
  Content counts;
  for (const auto& [channel, count] : counts_) {
    counts.number(channel).number(count);
    all += count;
  }
  return mcap_record(McapOp::kStatistics,
                     Content()
                         .number(all)
                         .number(static_cast<std::uint16_t>(schemas_.size()))
                         .number(static_cast<std::uint32_t>(channels_.size()))
                         .number(std::uint32_t{0})  // attachments
                         .number(std::uint32_t{0})  // metadata
                         .number(static_cast<std::uint32_t>(chunk_indexes_.size()))
                         .number(all == 0 ? 0 : first_time_)
                         .number(last_time_)
                         .text(counts.bytes));
}

void McapWriter::finish() {
  constexpr std::uint32_t kNoChecksum = 0;
  finish_chunk();
  append(mcap_record(McapOp::kDataEnd, Content().number(kNoChecksum)));
  const std::uint64_t start = position_;
  std::string summary = descriptions_ + statistics();
  for (const std::string& record : chunk_indexes_) summary += record;
  // The checksum includes the footer up to itself.
  std::string footer = mcap_record(
      McapOp::kFooter, Content().number(start).number(std::uint64_t{0}).number(kNoChecksum));
  footer.resize(footer.size() - sizeof kNoChecksum);
  append_bytes(footer, crc32(summary + footer));
  append(summary);
  append(footer);
  append(kMcapMagic);
  file_.commit();
}

}  // namespace mms
