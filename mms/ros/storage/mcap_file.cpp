#include "mms/ros/storage/mcap_file.hpp"

#include <algorithm>

#include "mms/core/error.hpp"
#include "mms/io/journal/crc32.hpp"

namespace mms {
namespace {

/// Channel, sequence number and two times of a message, before its data [B].
constexpr std::size_t kBeforeData =
    sizeof(std::uint16_t) + sizeof(std::uint32_t) + 2 * sizeof(std::uint64_t);

/// A time in nanoseconds; the last one that we can represent for later ones.
Timestamp take_time(ByteReader& reader) {
  constexpr std::uint64_t kLast = INT64_MAX;
  return Timestamp(static_cast<std::int64_t>(std::min(reader.take<std::uint64_t>(), kLast)));
}

std::string_view take_text(ByteReader& reader) {
  return reader.take(reader.take_count(1));
}

}  // namespace

McapFile::McapFile(const std::filesystem::path& path, const std::string& name)
    : ChunkedFile(path, name) {
  contents_.layout = "MCAP";
  if (file_.view(0, std::min(file_.size(), kMcapMagic.size())) != kMcapMagic) {
    throw DataError(name, "is not an MCAP file");
  }
  walk(kMcapMagic.size());
}

std::uint64_t McapFile::walk_record(std::uint64_t offset) {
  ByteReader head(file_.view(offset, kMcapHead), "record");
  const auto op = head.take<McapOp>();
  const auto size = head.take<std::uint64_t>();
  const std::uint64_t content = offset + kMcapHead;
  const bool complete = size <= file_.size() - content;
  if (op == McapOp::kChunk) add_chunk(content, std::min(size, file_.size() - content));
  if (!complete) throw DataError(file_.name(), "ends within a record");
  switch (op) {
    case McapOp::kSchema:
      add_schema(file_.view(content, size));
      break;
    case McapOp::kChannel:
      add_channel(file_.view(content, size));
      break;
    case McapOp::kMessage:
      add_message(file_.view(content, std::min<std::uint64_t>(size, kBeforeData)),
                  {.chunk = kNoChunk, .offset = offset});
      break;
    case McapOp::kMessageIndex:
      add_index(file_.view(content, size));
      break;
    case McapOp::kStatistics:
      check_statistics(file_.view(content, size));
      break;
    case McapOp::kFooter:
      check_footer(file_.view(content, size), offset);
      return file_.size();
    default:
      break;  // chunks are done above; others are not needed, or not known yet
  }
  return content + size;
}

void McapFile::add_chunk(std::uint64_t content, std::uint64_t size) {
  constexpr std::uint64_t kMaxBeforeRecords = 256;  // [B], of customary 40 or 41
  ByteReader head(file_.view(content, std::min(size, kMaxBeforeRecords)), "chunk");
  head.take(2 * sizeof(std::uint64_t));  // times of the first and last message
  Chunk chunk;
  chunk.raw_size = head.take<std::uint64_t>();
  chunk.crc = head.take<std::uint32_t>();
  chunk.compression = compression_of(take_text(head), file_.name());
  const auto announced = head.take<std::uint64_t>();
  const std::uint64_t before = std::min(size, kMaxBeforeRecords) - head.left();
  chunk.offset = content + before;
  chunk.size = std::min(announced, size - before);
  chunk.incomplete = chunk.size < announced;
  chunks_.push_back(chunk);
}

void McapFile::add_index(std::string_view content) {
  if (chunks_.empty()) throw DataError(file_.name(), "has an index without chunk");
  ByteReader reader(content, "the index of a chunk");
  const auto topic = reader.take<std::uint16_t>();
  ByteReader entries(take_text(reader), reader.where());
  while (entries.left() > 0) {
    const Timestamp time = take_time(entries);
    contents_.messages.push_back({.received = time,
                                  .topic = topic,
                                  .chunk = static_cast<std::uint32_t>(chunks_.size() - 1),
                                  .offset = entries.take<std::uint64_t>()});
  }
  chunks_.back().indexed = true;
}

void McapFile::add_message(std::string_view content, StoredMessage at) {
  ByteReader reader(content, "message");
  at.topic = reader.take<std::uint16_t>();
  reader.take(sizeof(std::uint32_t));  // sequence number
  at.received = take_time(reader);
  contents_.messages.push_back(at);
}

void McapFile::add_schema(std::string_view content) {
  ByteReader reader(content, "schema");
  const auto id = reader.take<std::uint16_t>();
  schemas_.emplace(id, take_text(reader));
}

void McapFile::add_channel(std::string_view content) {
  ByteReader reader(content, "channel");
  const auto id = reader.take<std::uint16_t>();
  const auto schema = schemas_.find(reader.take<std::uint16_t>());
  StoredTopic topic;
  topic.name = take_text(reader);
  topic.type = schema == schemas_.end() ? "no schema" : short_type(schema->second);
  const std::string_view encoding = take_text(reader);
  topic.format = encoding == "ros1" ? msg::WireFormat::kRos1 : msg::WireFormat::kCdr;
  if (encoding != "ros1" && encoding != "cdr") topic.type += " (" + std::string(encoding) + ")";
  describe_topic(id, std::move(topic));
}

void McapFile::check_statistics(std::string_view content) {
  const auto announced = ByteReader(content, "statistics").take<std::uint64_t>();
  const bool all_indexed =
      std::all_of(chunks_.begin(), chunks_.end(), [](const Chunk& chunk) { return chunk.indexed; });
  if (!all_indexed || announced == contents_.messages.size()) return;
  note_damage("has an index of " + std::to_string(contents_.messages.size()) +
              " messages, its statistics announce " + std::to_string(announced));
}

void McapFile::check_footer(std::string_view content, std::uint64_t offset) {
  closed_ = true;
  ByteReader reader(content, "footer");
  const auto summary = reader.take<std::uint64_t>();
  reader.take(sizeof(std::uint64_t));  // offsets in the summary
  const auto crc = reader.take<std::uint32_t>();
  const std::uint64_t end = offset + kMcapHead + content.size();
  if (file_.size() - end != kMcapMagic.size() || file_.view(end, kMcapMagic.size()) != kMcapMagic) {
    note_damage("does not end as an MCAP file");
  }
  if (summary == 0 || crc == 0) return;
  // The checksum includes the footer up to itself.
  const std::uint64_t last = end - sizeof crc;
  if (summary > last || crc32(file_.view(summary, last - summary)) != crc) {
    note_damage("has a damaged summary");
  }
}

void McapFile::scan_record(ByteReader& records, const StoredMessage& at, bool messages) {
  const auto op = records.take<McapOp>();
  const auto size = records.take<std::uint64_t>();
  const std::string_view content = records.take(static_cast<std::size_t>(size));
  if (op == McapOp::kSchema) add_schema(content);
  if (op == McapOp::kChannel) add_channel(content);
  if (op == McapOp::kMessage && messages) add_message(content, at);
}

std::string_view McapFile::record_at(std::uint64_t offset) {
  const auto size =
      ByteReader(file_.view(offset, kMcapHead), "record").take(kMcapHead).substr(sizeof(McapOp));
  return file_.view(offset, kMcapHead + ByteReader(size, "record").take<std::uint64_t>());
}

std::string_view McapFile::message_of(std::string_view record, const std::string& where) {
  ByteReader reader(record, where);
  if (reader.take<McapOp>() != McapOp::kMessage) {
    throw DataError(where, "is not where the index says");
  }
  const auto size = reader.take<std::uint64_t>();
  std::string_view content = reader.take(static_cast<std::size_t>(size));
  if (content.size() < kBeforeData) throw DataError(where, "ends too early");
  content.remove_prefix(kBeforeData);
  return content;
}

}  // namespace mms
