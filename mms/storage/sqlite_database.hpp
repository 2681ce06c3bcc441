#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace mms {

class SqliteDatabase;

/// A statement of SQL with parameters ?1, ?2, ... Faults of the database are `Error`s that name the
/// file.
class SqliteStatement {
 public:
  /// Values of the parameters, for the next execution.
  SqliteStatement& bind(int parameter, std::int64_t value);
  SqliteStatement& bind(int parameter, double value);
  SqliteStatement& bind_text(int parameter, std::string_view value);
  SqliteStatement& bind_blob(int parameter, std::string_view value);

  /// Goes to the next row. @returns false after the last one
  bool next();

  /// Executes a statement without rows, which may then be bound again.
  void run();

  /// Lets the statement be executed again.
  void reset();

  // Columns of the row, from 0. Views are valid until the next row.
  std::int64_t integer(int column) const;
  double real(int column) const;
  std::string_view text(int column) const;
  std::string_view blob(int column) const;

 private:
  friend class SqliteDatabase;
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  SqliteStatement(const SqliteDatabase& database, sqlite3_stmt* statement)
      : database_(&database), statement_(statement) {}

  const SqliteDatabase* database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

/// An SQLite database in a file, which may be damaged or made by others. One thread at a time.
class SqliteDatabase {
 public:
  enum class Access {
    kRead,      ///< an existing file, others may read and write
    kReadOnly,  ///< the same, but nothing is undone that a killed writer began
    kWrite,     ///< an existing file, others may read
    kCreate     ///< a new file
  };

  /// @param name  of the file in messages; empty: the path
  /// @throws FileError if the file cannot be opened, is no database, or another process writes it
  SqliteDatabase(const std::filesystem::path& path, Access access, const std::string& name = {});
  SqliteDatabase(const SqliteDatabase&) = delete;
  SqliteDatabase& operator=(const SqliteDatabase&) = delete;

  SqliteStatement prepare(std::string_view sql) const;

  /// Executes statements without parameters or rows.
  void execute(const std::string& sql) const;

  /// Throws the last fault of the database, as FileError for full disks and locks, as DataError for
  /// damage.
  [[noreturn]] void fail() const;

  std::string fault() const;  ///< what SQLite says of its last fault

  const std::string& name() const { return name_; }  ///< of the file, for messages

 private:
  bool open(const std::string& address, int flags);

  struct Close {
    void operator()(sqlite3* database) const;
  };

  std::string name_;
  std::unique_ptr<sqlite3, Close> database_;
};

}  // namespace mms
