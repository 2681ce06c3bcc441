#include "mms/storage/sqlite_database.hpp"

#include <sqlite3.h>

#include "mms/core/error.hpp"

namespace mms {
namespace {

/// [B]: largest value that is read or written.
constexpr int kMaxValue = 128 << 20U;

/// A reader may have to undo what a killed writer began. Files that cannot be written are opened
/// for reading by SQLite.
int flags_of(SqliteDatabase::Access access) {
  switch (access) {
    case SqliteDatabase::Access::kReadOnly:
      return SQLITE_OPEN_READONLY;
    case SqliteDatabase::Access::kCreate:
      return SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
    default:
      return SQLITE_OPEN_READWRITE;
  }
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

void SqliteStatement::Finalize::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

void SqliteDatabase::Close::operator()(sqlite3* database) const {
  sqlite3_close(database);
}

SqliteStatement& SqliteStatement::bind(int parameter, std::int64_t value) {
  if (sqlite3_bind_int64(statement_.get(), parameter, value) != SQLITE_OK) database_->fail();
  return *this;
}

SqliteStatement& SqliteStatement::bind(int parameter, double value) {
  if (sqlite3_bind_double(statement_.get(), parameter, value) != SQLITE_OK) database_->fail();
  return *this;
}

SqliteStatement& SqliteStatement::bind_text(int parameter, std::string_view value) {
  if (sqlite3_bind_text(statement_.get(), parameter, value.data(), static_cast<int>(value.size()),
                        SQLITE_TRANSIENT) != SQLITE_OK) {
    database_->fail();
  }
  return *this;
}

SqliteStatement& SqliteStatement::bind_blob(int parameter, std::string_view value) {
  if (sqlite3_bind_blob64(statement_.get(), parameter, value.data(), value.size(),
                          SQLITE_TRANSIENT) != SQLITE_OK) {
    database_->fail();
  }
  return *this;
}

bool SqliteStatement::next() {
  const int result = sqlite3_step(statement_.get());
  if (result != SQLITE_ROW && result != SQLITE_DONE) database_->fail();
  return result == SQLITE_ROW;
}

void SqliteStatement::run() {
  next();
  reset();
}

void SqliteStatement::reset() {
  sqlite3_reset(statement_.get());
}

std::int64_t SqliteStatement::integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

double SqliteStatement::real(int column) const {
  return sqlite3_column_double(statement_.get(), column);
}

std::string_view SqliteStatement::text(int column) const {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
  if (text == nullptr) return {};
  return {text, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

std::string_view SqliteStatement::blob(int column) const {
  const auto* data = static_cast<const char*>(sqlite3_column_blob(statement_.get(), column));
  if (data == nullptr) return {};
  return {data, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

SqliteDatabase::SqliteDatabase(const std::filesystem::path& path, Access access,
                               const std::string& name)
    : name_(name.empty() ? path.string() : name) {
  const bool reads = access == Access::kRead || access == Access::kReadOnly;
  if (!open(path.string(), flags_of(access)) &&
      (access != Access::kReadOnly ||
       !open(unlocked_address(path), SQLITE_OPEN_READONLY | SQLITE_OPEN_URI))) {
    fail();
  }
  constexpr int kWait = 60'000;  // for readers of a whole map, or the end of a write [ms]
  sqlite3_busy_timeout(database_.get(), reads ? kWait : 0);
  if (access == Access::kRead) execute("PRAGMA query_only = 1; SELECT count(*) FROM sqlite_schema");
  if (reads) return;
  execute("BEGIN IMMEDIATE");
  sqlite3_busy_timeout(database_.get(), kWait);
}

/// @returns false if the file, or what is needed beside it, cannot be opened
bool SqliteDatabase::open(const std::string& address, int flags) {
  sqlite3* opened = nullptr;
  const int result = sqlite3_open_v2(address.c_str(), &opened, flags, nullptr);
  database_.reset(opened);
  if (result != SQLITE_OK) return false;
  // The file is untrusted: no functions in its definitions, no values beyond our limit.
  sqlite3_db_config(opened, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, kMaxValue);
  return (flags & SQLITE_OPEN_READONLY) == 0 ||
         sqlite3_exec(opened, "SELECT 1 FROM sqlite_schema LIMIT 1", nullptr, nullptr, nullptr) !=
             SQLITE_CANTOPEN;
}

SqliteStatement SqliteDatabase::prepare(std::string_view sql) const {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(database_.get(), sql.data(), static_cast<int>(sql.size()), &statement,
                         nullptr) != SQLITE_OK) {
    fail();
  }
  return SqliteStatement(*this, statement);
}

void SqliteDatabase::execute(const std::string& sql) const {
  if (sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

std::string SqliteDatabase::fault() const {
  return sqlite3_errmsg(database_.get());
}

void SqliteDatabase::fail() const {
  const std::string message = fault();
  switch (sqlite3_errcode(database_.get()) & 0xFF) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      throw FileError(name_, "is in use by another process",
                      "wait until that run ends, or choose another file");
    case SQLITE_FULL:
      throw FileError(name_, "cannot be written: the disk is full");
    case SQLITE_CANTOPEN:
    case SQLITE_PERM:
    case SQLITE_READONLY:
    case SQLITE_IOERR:
      throw FileError(name_, "cannot be opened or written: " + message,
                      "check that it exists, and its permissions");
    case SQLITE_NOMEM:
      throw std::bad_alloc();
    default:
      throw DataError(name_, "is damaged: " + message);
  }
}

}  // namespace mms
