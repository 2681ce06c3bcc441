#include "mms/ros/storage/sqlite_bag.hpp"

#include <sqlite3.h>

#include <algorithm>

#include "mms/core/error.hpp"
#include "mms/ros/storage/input_file.hpp"

namespace mms {
namespace {

std::string text_of(sqlite3_stmt* row, int column) {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(row, column));
  return text == nullptr ? "" : text;
}

/// The address of a database that nobody writes, for folders in which no lock can be made.
std::string unlocked_address(const std::filesystem::path& path) {
  std::string address = "file:";
  for (const char c : std::filesystem::absolute(path).string()) {
    if (c == '?') {
      address += "%3f";
    } else if (c == '#') {
      address += "%23";
    } else if (c == '%') {
      address += "%25";
    } else {
      address += c;
    }
  }
  return address + "?immutable=1";
}

}  // namespace

void SqliteBag::Close::operator()(sqlite3* database) const {
  sqlite3_close(database);
}
void SqliteBag::Close::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

SqliteBag::SqliteBag(const std::filesystem::path& path, const std::string& name) : name_(name) {
  constexpr std::string_view kStart = "SQLite format 3";
  InputFile file(path, name);
  if (file.size() < kStart.size() || file.view(0, kStart.size()) != kStart) {
    throw DataError(name, "is not a database of rosbag2 (SQLite 3)");
  }
  contents_.layout = "rosbag2 database";
  database_ = open(path);
  check_tables();
  read_messages(read_topics(), file.size());
  data_ = prepare("SELECT data FROM messages WHERE id = ?1");
}

SqliteBag::Database SqliteBag::open(const std::filesystem::path& path) const {
  sqlite3* opened = nullptr;
  Database database;
  const auto try_open = [&](const std::string& address) {
    const int result =
        sqlite3_open_v2(address.c_str(), &opened, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
    database.reset(opened);
    // The file is untrusted: no functions in its definitions, no blocks beyond our limit.
    sqlite3_db_config(opened, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, static_cast<int>(kMaxBlock));
    return result == SQLITE_OK && sqlite3_exec(opened, "SELECT 1 FROM sqlite_schema LIMIT 1",
                                               nullptr, nullptr, nullptr) != SQLITE_CANTOPEN;
  };
  if (try_open(path.string()) || try_open(unlocked_address(path))) return database;
  throw FileError(name_, std::string("cannot be opened: ") + sqlite3_errmsg(database.get()));
}

SqliteBag::Statement SqliteBag::prepare(const char* sql) const {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(database_.get(), sql, -1, &statement, nullptr) != SQLITE_OK) {
    throw DataError(name_, std::string("is damaged or not a recording of rosbag2: ") +
                               sqlite3_errmsg(database_.get()));
  }
  return Statement(statement);
}

void SqliteBag::check_tables() const {
  // A view could compute without end.
  const Statement tables = prepare(
      "SELECT count(*) FROM sqlite_schema WHERE type = 'table' AND name IN ('topics', 'messages') "
      "AND sql LIKE 'CREATE TABLE%'");
  if (sqlite3_step(tables.get()) == SQLITE_ROW && sqlite3_column_int(tables.get(), 0) == 2) return;
  throw DataError(name_, "is not a recording of rosbag2: it has no tables 'topics' and 'messages'");
}

bool SqliteBag::next_row(const Statement& statement, const std::string& what) {
  const int result = sqlite3_step(statement.get());
  if (result == SQLITE_ROW) return true;
  if (result != SQLITE_DONE) {
    note_damage("is damaged in its " + what + " (" + sqlite3_errmsg(database_.get()) +
                "); what is before is read");
  }
  return false;
}

void SqliteBag::note_damage(const std::string& what) {
  if (contents_.damage.empty()) contents_.damage = name_ + ": " + what;
}

SqliteBag::TopicNumbers SqliteBag::read_topics() {
  TopicNumbers numbers;
  const Statement rows =
      prepare("SELECT id, name, type, serialization_format FROM topics ORDER BY id");
  while (next_row(rows, "table of topics")) {
    StoredTopic topic{text_of(rows.get(), 1), short_type(text_of(rows.get(), 2)),
                      msg::WireFormat::kCdr};
    const std::string format = text_of(rows.get(), 3);
    if (format != "cdr") topic.type += " (" + format + ")";
    numbers[sqlite3_column_int64(rows.get(), 0)] =
        static_cast<std::uint32_t>(contents_.topics.size());
    contents_.topics.push_back(std::move(topic));
  }
  return numbers;
}

void SqliteBag::read_messages(const TopicNumbers& numbers, std::uint64_t file_size) {
  // A damaged tree may repeat pages without end.
  constexpr std::uint64_t kRowSize = 5;  // head, three columns and a byte of data [B]
  // In the order of rows; the data come last in a row and are not read.
  const Statement rows = prepare("SELECT id, topic_id, timestamp FROM messages");
  std::size_t unknown = 0;
  for (std::uint64_t row = 0; next_row(rows, "message " + std::to_string(row)); ++row) {
    if (row > file_size / kRowSize) return note_damage("has more messages than fit into it");
    const auto topic = numbers.find(sqlite3_column_int64(rows.get(), 1));
    if (topic == numbers.end()) {
      ++unknown;
      continue;
    }
    contents_.messages.push_back(
        {.received = Timestamp(std::max<std::int64_t>(0, sqlite3_column_int64(rows.get(), 2))),
         .topic = topic->second,
         .offset = static_cast<std::uint64_t>(sqlite3_column_int64(rows.get(), 0))});
  }
  if (unknown > 0) {
    note_damage("has " + std::to_string(unknown) + " messages of topics that it does not describe");
  }
}

std::string_view SqliteBag::read(const StoredMessage& message, const std::string& where) {
  sqlite3_reset(data_.get());
  sqlite3_bind_int64(data_.get(), 1, static_cast<sqlite3_int64>(message.offset));
  if (sqlite3_step(data_.get()) != SQLITE_ROW) {
    throw DataError(where, std::string("cannot be read: ") + sqlite3_errmsg(database_.get()));
  }
  const auto* data = static_cast<const char*>(sqlite3_column_blob(data_.get(), 0));
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(data_.get(), 0));
  if (data == nullptr) throw DataError(where, "has no data");
  return {data, size};
}

}  // namespace mms
