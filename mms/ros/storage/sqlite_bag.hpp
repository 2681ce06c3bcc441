#pragma once

#include <filesystem>
#include <map>
#include <optional>

#include "mms/ros/storage/bag_storage.hpp"
#include "mms/storage/sqlite_database.hpp"

namespace mms {

/// A .db3 file of rosbag2 (ros2/rosbag2, rosbag2_storage_sqlite3; schema versions 1 to 4): tables
/// `topics` and `messages`. Of a damaged file, the rows before the damage are read.
class SqliteBag final : public BagStorage {
 public:
  /// @param name  of the file in messages
  /// @throws FileError if it cannot be opened; DataError if it is not such a database.
  SqliteBag(const std::filesystem::path& path, const std::string& name);

  const BagContents& contents() const override { return contents_; }
  std::string_view read(const StoredMessage& message, const std::string& where) override;

 private:
  using TopicNumbers = std::map<std::int64_t, std::uint32_t>;  ///< by id in the database

  SqliteStatement prepare(const char* sql) const;
  void check_tables() const;
  TopicNumbers read_topics();
  void read_messages(const TopicNumbers& numbers, std::uint64_t file_size);
  /// @returns whether there is a row; notes damage.
  bool next_row(SqliteStatement& statement, const std::string& what);
  void note_damage(const std::string& what);

  std::string name_;
  std::optional<SqliteDatabase> database_;
  std::optional<SqliteStatement> data_;  ///< of the message of a row
  BagContents contents_;
};

}  // namespace mms
