#include "mms/ros/storage/chunked_file.hpp"

#include <algorithm>
#include <set>

#include "mms/core/error.hpp"
#include "mms/io/journal/crc32.hpp"

namespace mms {
namespace {

/// [B]: sum of the decompressed chunks up to which a file is read in any case.
constexpr std::uint64_t kMaxSurely = std::uint64_t{256} << 20U;
/// Largest ratio of that sum and the size of the file; recordings are compressed by 2 to 20.
constexpr std::uint64_t kMaxRatio = 200;

}  // namespace

void ChunkedFile::walk(std::uint64_t offset) {
  try {
    while (offset < file_.size()) offset = walk_record(offset);
  } catch (const DataError& error) {
    note_damage("is damaged or truncated at byte " + std::to_string(offset) + " of " +
                std::to_string(file_.size()) + " (" + error.what() + "); what is before is read");
    closed_ = false;
  }
  if (!closed_) {
    note_damage("was not closed; what was written is read");
    forget_last_index();
  }
  leave_out_implausible_chunks();
  for (std::uint32_t i = 0; i < chunks_.size(); ++i) {
    if (!chunks_[i].indexed) scan_chunk(i, true);
  }
  std::set<std::uint32_t> ids;
  for (const StoredMessage& message : contents_.messages) ids.insert(message.topic);
  const auto known = [this](std::uint32_t id) { return topic_of_id_.contains(id); };
  for (std::uint32_t i = 0; i < chunks_.size() && !std::all_of(ids.begin(), ids.end(), known);
       ++i) {
    scan_chunk(i, false);
  }
  resolve_topics();
}

void ChunkedFile::leave_out_implausible_chunks() {
  std::uint64_t left = kMaxSurely + kMaxRatio * file_.size();
  for (std::size_t i = 0; i < chunks_.size(); ++i) {
    const std::uint64_t size = std::min(chunks_[i].raw_size, kMaxBlock);
    if (size <= left) {
      left -= size;
      continue;
    }
    note_damage(
        "its chunks from byte " + std::to_string(chunks_[i].offset) + " on are larger than " +
        std::to_string(kMaxRatio) +
        " times its size when decompressed; what is before is read (if that is right, write it "
        "without compression)");
    chunks_.resize(i);
    std::erase_if(contents_.messages,
                  [i](const StoredMessage& m) { return m.chunk != kNoChunk && m.chunk >= i; });
  }
}

void ChunkedFile::forget_last_index() {
  if (chunks_.empty()) return;
  const std::size_t last = chunks_.size() - 1;
  std::erase_if(contents_.messages, [&](const StoredMessage& m) { return m.chunk == last; });
  chunks_.back().indexed = false;
}

void ChunkedFile::describe_topic(std::uint32_t id, StoredTopic topic) {
  const auto number = static_cast<std::uint32_t>(contents_.topics.size());
  if (topic_of_id_.emplace(id, number).second) contents_.topics.push_back(std::move(topic));
}

void ChunkedFile::note_damage(const std::string& what) {
  if (contents_.damage.empty()) contents_.damage = file_.name() + ": " + what;
}

void ChunkedFile::scan_chunk(std::uint32_t chunk, bool messages) {
  try {
    const std::string_view bytes = content(chunk);
    ByteReader records(bytes, "chunk");
    while (records.left() > 0) {
      scan_record(records, {.chunk = chunk, .offset = bytes.size() - records.left()}, messages);
      // Each message has a time of its own, and takes a byte at least.
      if (contents_.messages.size() > file_.size()) {
        throw DataError(file_.name(), "has more messages than bytes");
      }
    }
  } catch (const DataError& error) {
    note_damage("its chunk at byte " + std::to_string(chunks_[chunk].offset) + " is damaged (" +
                error.what() + ")");
  }
}

void ChunkedFile::resolve_topics() {
  const std::size_t removed = std::erase_if(contents_.messages, [this](const StoredMessage& m) {
    return !topic_of_id_.contains(m.topic);
  });
  if (removed > 0) {
    note_damage("has " + std::to_string(removed) + " messages of topics that it does not describe");
  }
  for (StoredMessage& message : contents_.messages) message.topic = topic_of_id_[message.topic];
}

std::string_view ChunkedFile::content(std::uint32_t chunk) {
  // Color and depth images of one time are often in neighboring chunks.
  constexpr std::size_t kKept = 3;
  const auto found = std::find_if(recent_.begin(), recent_.end(),
                                  [&](const Content& content) { return content.chunk == chunk; });
  if (found != recent_.end()) {
    std::rotate(found, found + 1, recent_.end());
    return recent_.back().bytes;
  }
  const Chunk& at = chunks_.at(chunk);
  const std::string where = file_.name() + ": chunk at byte " + std::to_string(at.offset);
  if (at.raw_size > kMaxBlock) {
    throw DataError(where, "has " + std::to_string(at.raw_size) + " bytes, allowed: up to " +
                               std::to_string(kMaxBlock));
  }
  std::uint64_t kept = at.raw_size;
  for (const Content& content : recent_) kept += content.bytes.capacity();
  while (!recent_.empty() && (recent_.size() == kKept || kept > kMaxBlock)) {
    kept -= recent_.front().bytes.capacity();
    recent_.erase(recent_.begin());
  }
  const std::string_view compressed = file_.view(at.offset, at.size);
  std::string bytes = at.incomplete ? decompress_start(compressed, at.compression, at.raw_size)
                                    : decompress(compressed, at.compression, at.raw_size, where);
  if (!at.incomplete && (bytes.size() != at.raw_size || (at.crc != 0 && crc32(bytes) != at.crc))) {
    throw DataError(where, "is damaged: its size or checksum is wrong");
  }
  bytes.shrink_to_fit();
  recent_.push_back({chunk, std::move(bytes)});
  return recent_.back().bytes;
}

std::string_view ChunkedFile::record_at(std::uint64_t) {
  throw DataError(file_.name(), "has no messages outside of chunks");
}

std::string_view ChunkedFile::read(const StoredMessage& message, const std::string& where) {
  if (message.chunk == kNoChunk) return message_of(record_at(message.offset), where);
  const std::string_view bytes = content(message.chunk);
  if (message.offset >= bytes.size()) throw DataError(where, "is beyond the end of its chunk");
  return message_of(bytes.substr(static_cast<std::size_t>(message.offset)), where);
}

}  // namespace mms
