#pragma once

#include <filesystem>
#include <map>
#include <memory>

#include "mms/ros/storage/bag_storage.hpp"

struct sqlite3;
struct sqlite3_stmt;

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
  struct Close {
    void operator()(sqlite3* database) const;
    void operator()(sqlite3_stmt* statement) const;
  };
  using Database = std::unique_ptr<sqlite3, Close>;
  using Statement = std::unique_ptr<sqlite3_stmt, Close>;
  using TopicNumbers = std::map<std::int64_t, std::uint32_t>;  ///< by id in the database

  Database open(const std::filesystem::path& path) const;
  Statement prepare(const char* sql) const;
  void check_tables() const;
  TopicNumbers read_topics();
  void read_messages(const TopicNumbers& numbers, std::uint64_t file_size);
  /// @returns whether there is a row; notes damage.
  bool next_row(const Statement& statement, const std::string& what);
  void note_damage(const std::string& what);

  std::string name_;
  Database database_;
  Statement data_;  ///< of the message of a row
  BagContents contents_;
};

}  // namespace mms
