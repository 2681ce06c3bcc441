// Databases in files, and checksums of compressed blocks.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "mms/core/error.hpp"
#include "mms/storage/compression.hpp"
#include "mms/storage/sqlite_database.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::TempFolder;
using Access = SqliteDatabase::Access;

std::string message_of(const std::filesystem::path& path, Access access) {
  try {
    const SqliteDatabase database(path, access);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SqliteDatabase, KeepsValuesOfEveryType) {
  const TempFolder folder;
  const std::filesystem::path path = folder.path() / "a.db";
  const std::string bytes("a\0b", 3);
  {
    const SqliteDatabase database(path, Access::kCreate);
    database.execute("CREATE TABLE t (i INTEGER, r REAL, s TEXT, b BLOB)");
    SqliteStatement row = database.prepare("INSERT INTO t VALUES (?1, ?2, ?3, ?4)");
    row.bind(1, std::int64_t{1} << 60).bind(2, 0.1).bind_text(3, "text").bind_blob(4, bytes).run();
    row.bind(1, std::int64_t{7}).run();
    database.execute("COMMIT");
  }
  const SqliteDatabase database(path, Access::kRead);
  SqliteStatement rows = database.prepare("SELECT * FROM t");
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(rows.integer(0), std::int64_t{1} << 60);
  EXPECT_EQ(rows.real(1), 0.1);
  EXPECT_EQ(rows.text(2), "text");
  EXPECT_EQ(rows.blob(3), bytes);
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(rows.integer(0), 7);
  EXPECT_FALSE(rows.next());
}

TEST(SqliteDatabase, WithoutCommitNothingIsWritten) {
  const TempFolder folder;
  const std::filesystem::path path = folder.path() / "a.db";
  { SqliteDatabase(path, Access::kCreate).execute("CREATE TABLE t (i INTEGER)"); }
  const SqliteDatabase database(path, Access::kRead);
  SqliteStatement count = database.prepare("SELECT count(*) FROM sqlite_schema");
  ASSERT_TRUE(count.next());
  EXPECT_EQ(count.integer(0), 0);
}

TEST(SqliteDatabase, FaultsNameTheFile) {
  const TempFolder folder;
  const std::filesystem::path path = folder.path() / "a.db";
  EXPECT_NE(message_of(path, Access::kRead).find("a.db: cannot be opened"), std::string::npos);
  std::ofstream(path) << std::string(1000, 'x');
  EXPECT_NE(message_of(path, Access::kRead).find("a.db: is damaged"), std::string::npos);
  const SqliteDatabase writer(folder.path() / "b.db", Access::kCreate);
  EXPECT_NE(message_of(folder.path() / "b.db", Access::kWrite).find("another process"),
            std::string::npos);
}

TEST(Compression, EveryChangedByteIsNoticed) {
  std::string bytes;
  for (int i = 0; i < 3000; ++i) bytes.push_back(static_cast<char>(i * i % 251));
  const std::string compressed = compress_zstd(bytes);
  EXPECT_EQ(decompress(compressed, Compression::kZstd, 1 << 20U, "a"), bytes);
  for (std::size_t i = 0; i < compressed.size(); ++i) {
    std::string damaged = compressed;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    try {
      EXPECT_EQ(decompress(damaged, Compression::kZstd, 1 << 20U, "a"), bytes) << i;
    } catch (const DataError&) {
      continue;
    }
  }
}

TEST(Compression, RefusesFilesThatGrowTooMuch) {
  const TempFolder folder;
  const auto from = folder.write("a.mcap.zstd", compress_zstd(std::string(600 << 20, '\0')));
  try {
    decompress_zstd_file(from, folder.path() / "a.mcap");
    ADD_FAILURE();
  } catch (const DataError& error) {
    testing::expect_in("is larger than 200 times its size", error.what());
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.mcap"));
  const auto pipe = folder.path() / "b.mcap.zstd";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(decompress_zstd_file(pipe, folder.path() / "b.mcap"), FileError);
}

}  // namespace
}  // namespace mms
