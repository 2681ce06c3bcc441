#include "tests/ros/sample_bags.hpp"

#include <gtest/gtest.h>
#include <lz4frame.h>
#include <sqlite3.h>

#include <map>

#include "mms/io/journal/byte_reader.hpp"
#include "mms/io/journal/crc32.hpp"

namespace mms::testing {
namespace {

class Sqlite {
 public:
  explicit Sqlite(const std::filesystem::path& path) {
    std::filesystem::remove(path);
    EXPECT_EQ(sqlite3_open(path.c_str(), &database_), SQLITE_OK);
  }
  ~Sqlite() { sqlite3_close(database_); }
  Sqlite(const Sqlite&) = delete;
  Sqlite& operator=(const Sqlite&) = delete;

  void run(const std::string& sql) {
    EXPECT_EQ(sqlite3_exec(database_, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
        << sql << ": " << sqlite3_errmsg(database_);
  }
  void insert_message(int topic, Timestamp time, const std::string& bytes) {
    sqlite3_stmt* row = nullptr;
    sqlite3_prepare_v2(database_,
                       "INSERT INTO messages (timestamp, topic_id, data) VALUES (?, ?, ?)", -1,
                       &row, nullptr);
    sqlite3_bind_int64(row, 1, time.nanoseconds());
    sqlite3_bind_int(row, 2, topic);
    sqlite3_bind_blob(row, 3, bytes.data(), static_cast<int>(bytes.size()), SQLITE_TRANSIENT);
    EXPECT_EQ(sqlite3_step(row), SQLITE_DONE);
    sqlite3_finalize(row);
  }

 private:
  sqlite3* database_ = nullptr;
};

template <class T>
std::string number(T value) {
  std::string bytes;
  append_bytes(bytes, value);
  return bytes;
}
std::string text(const std::string& value) {
  return number(static_cast<std::uint32_t>(value.size())) + value;
}
std::string record(std::uint8_t op, const std::string& content) {
  return number(op) + number(std::uint64_t{content.size()}) + content;
}

std::string compressed(const std::string& bytes, const std::string& compression) {
  if (compression == "zstd") return compress_zstd(bytes);
  if (compression != "lz4") return bytes;
  std::string result(LZ4F_compressFrameBound(bytes.size(), nullptr), '\0');
  result.resize(
      LZ4F_compressFrame(result.data(), result.size(), bytes.data(), bytes.size(), nullptr));
  return result;
}

}  // namespace

void write_db3(const std::filesystem::path& path, const std::vector<SerializedMessage>& messages,
               const Db3Options& options) {
  Sqlite db(path);
  std::string columns =
      "id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
      "serialization_format TEXT NOT NULL";
  if (options.schema >= 2) columns += ", offered_qos_profiles TEXT NOT NULL";
  if (options.schema >= 4) columns += ", type_description_hash TEXT NOT NULL";
  db.run("BEGIN");
  db.run("CREATE TABLE topics(" + columns + ")");
  db.run(
      "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, "
      "timestamp INTEGER NOT NULL, data BLOB NOT NULL)");
  db.run("CREATE INDEX timestamp_idx ON messages (timestamp ASC)");
  if (options.schema >= 3) {
    db.run("CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL)");
    db.run("INSERT INTO schema VALUES (" + std::to_string(options.schema) + ", 'jazzy')");
    db.run(
        "CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, "
        "metadata TEXT NOT NULL)");
  }
  std::map<std::string, int> topics;
  for (const SerializedMessage& message : messages) {
    const auto [topic, is_new] = topics.emplace(message.topic, int(topics.size()) + 1);
    if (is_new) {
      db.run("INSERT INTO topics VALUES (" + std::to_string(topic->second) + ", '" + message.topic +
             "', '" + message.type + "', '" + options.encoding + "'" +
             (options.schema >= 2 ? ", ''" : "") + (options.schema >= 4 ? ", ''" : "") + ")");
    }
    db.insert_message(topic->second, message.recorded,
                      options.zstd_messages ? compress_zstd(message.bytes) : message.bytes);
  }
  db.run("COMMIT");
}

std::string mcap_bytes(const std::vector<SerializedMessage>& messages, const McapOptions& options) {
  const std::string magic("\x89MCAP0\r\n", 8);
  std::string file = magic + record(1, text("ros2") + text("test"));
  std::string descriptions;
  std::map<std::string, std::uint16_t> channels;
  std::map<std::uint16_t, std::string> index;
  std::string records;
  const auto close_chunk = [&] {
    const std::string packed = compressed(records, options.compression);
    file +=
        record(6, number(std::uint64_t{0}) + number(std::uint64_t{0}) +
                      number(std::uint64_t{records.size()}) + number(crc32(records)) +
                      text(options.compression) + number(std::uint64_t{packed.size()}) + packed);
    for (const auto& [channel, entries] : index) {
      if (options.indexes) file += record(7, number(channel) + text(entries));
    }
    index.clear();
    records.clear();
  };
  std::size_t count = 0;
  for (const SerializedMessage& message : messages) {
    std::string& place = options.chunks ? records : file;
    const auto next = static_cast<std::uint16_t>(channels.size() + 1);
    const auto [channel, is_new] = channels.emplace(message.topic, next);
    if (is_new) {
      const std::string description =
          record(3, number(next) + text(message.type) + text("ros2msg") + text("")) +
          record(4, number(next) + number(next) + text(message.topic) + text(options.encoding) +
                        text(""));
      descriptions += description;
      place += description;
    }
    const auto time = static_cast<std::uint64_t>(message.recorded.nanoseconds());
    index[channel->second] += number(time) + number(std::uint64_t{records.size()});
    place += record(5, number(channel->second) + number(std::uint32_t{0}) + number(time) +
                           number(time) + message.bytes);
    if (options.chunks && ++count % options.messages_per_chunk == 0) close_chunk();
  }
  if (!records.empty()) close_chunk();
  if (!options.summary) return file;
  file += record(15, number(std::uint32_t{0}));
  const std::uint64_t start = file.size();
  return file + descriptions +
         record(2, number(start) + number(std::uint64_t{0}) + number(std::uint32_t{0})) + magic;
}

void write_sample(BagWriter& bag) {
  for (int i = 0; i < 5; ++i) {
    msg::Image image;
    image.header.stamp = Timestamp(i);
    image.encoding = "mono8";
    image.data.assign(100, static_cast<std::uint8_t>(i));
    bag.write("/image", Timestamp(100 + i), image);
    if (i == 2) bag.write("/pose", Timestamp(50), msg::PoseStamped());
    if (i == 3) bag.write("/tf", Timestamp(60), msg::Transforms{{msg::TransformStamped()}});
  }
}

}  // namespace mms::testing
