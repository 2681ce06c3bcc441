#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "mms/io/journal/byte_reader.hpp"
#include "mms/ros/storage/bag_storage.hpp"
#include "mms/ros/storage/input_file.hpp"
#include "mms/storage/compression.hpp"

namespace mms {

/// Block of records in a file.
struct Chunk {
  std::uint64_t offset = 0;    ///< of its compressed records in the file [B]
  std::uint64_t size = 0;      ///< compressed [B]
  std::uint64_t raw_size = 0;  ///< decompressed [B]
  Compression compression = Compression::kNone;
  std::uint32_t crc = 0;    ///< of the decompressed records; 0: unknown
  bool indexed = false;     ///< the file has an index of its messages
  bool incomplete = false;  ///< the file ends within it
};

/// Common part of ROS 1 bags and MCAP files: a sequence of records, some of them chunks of other
/// records, each followed by an index of its messages. The file is walked from record to record
/// without reading the chunks; so the summary at its end is not needed, and what is before a
/// damage is found. Chunks without index are read, and all of them if the descriptions of topics
/// at the end are missing.
class ChunkedFile : public BagStorage {
 public:
  const BagContents& contents() const final { return contents_; }
  std::string_view read(const StoredMessage& message, const std::string& where) final;

 protected:
  /// Chunk number of messages outside of chunks.
  static constexpr std::uint32_t kNoChunk = UINT32_MAX;

  ChunkedFile(const std::filesystem::path& path, const std::string& name) : file_(path, name) {}

  /// Finds topics and messages of the records from `offset` on, and notes damage.
  void walk(std::uint64_t offset);

  /// Interprets the record at `offset` of the file.
  /// @returns the offset of the next record; the size of the file after the last one
  /// @throws DataError if it is damaged.
  virtual std::uint64_t walk_record(std::uint64_t offset) = 0;

  /// Interprets the next record of a chunk.
  /// @param at        where its message would be
  /// @param messages  false: descriptions of topics alone
  /// @throws DataError if it is damaged.
  virtual void scan_record(ByteReader& records, const StoredMessage& at, bool messages) = 0;

  /// The message of the record at the beginning of the bytes.
  /// @throws DataError if there is none.
  virtual std::string_view message_of(std::string_view record, const std::string& where) = 0;

  /// The record of a message outside of chunks.
  virtual std::string_view record_at(std::uint64_t offset);

  /// The number of the id that the format gives a topic, as StoredMessage::topic until the end of
  /// the walk.
  void describe_topic(std::uint32_t id, StoredTopic topic);

  void note_damage(const std::string& what);

  InputFile file_;
  BagContents contents_;
  std::vector<Chunk> chunks_;
  bool closed_ = false;  ///< the file was completed by its writer

 private:
  struct Content {
    std::uint32_t chunk = kNoChunk;
    std::string bytes;
  };

  std::string_view content(std::uint32_t chunk);
  void scan_chunk(std::uint32_t chunk, bool messages);
  /// The index of the last chunk of an incomplete file may be incomplete, too.
  void forget_last_index();
  void resolve_topics();
  /// A small file may say that its chunks are thousands of times larger when decompressed.
  void leave_out_implausible_chunks();

  std::map<std::uint32_t, std::uint32_t> topic_of_id_;
  std::vector<Content> recent_;  ///< chunks decompressed last, the latest at the end
};

}  // namespace mms
