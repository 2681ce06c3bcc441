#include "mms/ros/storage/sqlite_bag.hpp"

#include <algorithm>

#include "mms/core/error.hpp"
#include "mms/ros/storage/input_file.hpp"

namespace mms {
SqliteBag::SqliteBag(const std::filesystem::path& path, const std::string& name) : name_(name) {
  constexpr std::string_view kStart = "SQLite format 3";
  InputFile file(path, name);
  if (file.size() < kStart.size() || file.view(0, kStart.size()) != kStart) {
    throw DataError(name, "is not a database of rosbag2 (SQLite 3)");
  }
  contents_.layout = "rosbag2 database";
  database_.emplace(path, SqliteDatabase::Access::kReadOnly, name);
  check_tables();
  read_messages(read_topics(), file.size());
  data_ = prepare("SELECT data FROM messages WHERE id = ?1");
}

SqliteStatement SqliteBag::prepare(const char* sql) const {
  try {
    return database_->prepare(sql);
  } catch (const Error&) {
    throw DataError(name_, "is damaged or not a recording of rosbag2: " + database_->fault());
  }
}

void SqliteBag::check_tables() const {
  // A view could compute without end.
  SqliteStatement tables = prepare(
      "SELECT count(*) FROM sqlite_schema WHERE type = 'table' AND name IN ('topics', 'messages') "
      "AND sql LIKE 'CREATE TABLE%'");
  if (tables.next() && tables.integer(0) == 2) return;
  throw DataError(name_, "is not a recording of rosbag2: it has no tables 'topics' and 'messages'");
}

bool SqliteBag::next_row(SqliteStatement& statement, const std::string& what) {
  try {
    return statement.next();
  } catch (const Error&) {
    note_damage("is damaged in its " + what + " (" + database_->fault() +
                "); what is before is read");
    return false;
  }
}

void SqliteBag::note_damage(const std::string& what) {
  if (contents_.damage.empty()) contents_.damage = name_ + ": " + what;
}

SqliteBag::TopicNumbers SqliteBag::read_topics() {
  TopicNumbers numbers;
  SqliteStatement rows =
      prepare("SELECT id, name, type, serialization_format FROM topics ORDER BY id");
  while (next_row(rows, "table of topics")) {
    StoredTopic topic{std::string(rows.text(1)), short_type(std::string(rows.text(2))),
                      msg::WireFormat::kCdr};
    const std::string format(rows.text(3));
    if (format != "cdr") topic.type += " (" + format + ")";
    numbers[rows.integer(0)] = static_cast<std::uint32_t>(contents_.topics.size());
    contents_.topics.push_back(std::move(topic));
  }
  return numbers;
}

void SqliteBag::read_messages(const TopicNumbers& numbers, std::uint64_t file_size) {
  // A damaged tree may repeat pages without end.
  constexpr std::uint64_t kRowSize = 5;  // head, three columns and a byte of data [B]
  // In the order of rows; the data come last in a row and are not read.
  SqliteStatement rows = prepare("SELECT id, topic_id, timestamp FROM messages");
  std::size_t unknown = 0;
  for (std::uint64_t row = 0; next_row(rows, "message " + std::to_string(row)); ++row) {
    if (row > file_size / kRowSize) return note_damage("has more messages than fit into it");
    const auto topic = numbers.find(rows.integer(1));
    if (topic == numbers.end()) {
      ++unknown;
      continue;
    }
    contents_.messages.push_back({.received = Timestamp(std::max<std::int64_t>(0, rows.integer(2))),
                                  .topic = topic->second,
                                  .offset = static_cast<std::uint64_t>(rows.integer(0))});
  }
  if (unknown > 0) {
    note_damage("has " + std::to_string(unknown) + " messages of topics that it does not describe");
  }
}

std::string_view SqliteBag::read(const StoredMessage& message, const std::string& where) {
  data_->reset();
  data_->bind(1, static_cast<std::int64_t>(message.offset));
  bool found = false;
  try {
    found = data_->next();
  } catch (const Error&) {  // below
  }
  if (!found) throw DataError(where, "cannot be read: " + database_->fault());
  const std::string_view data = data_->blob(0);
  if (data.data() == nullptr) throw DataError(where, "has no data");
  return data;
}

}  // namespace mms
