#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mms/global_map/global_map.hpp"
#include "mms/io/text/temporary_path.hpp"
#include "mms/map_file/map_claim.hpp"
#include "mms/map_file/map_session.hpp"
#include "mms/mapping/static_map/map_cloud.hpp"
#include "mms/storage/sqlite_database.hpp"

namespace mms {

/// A map on disk (docs/map_file.md): sessions with their keyframes, loops and static maps, in one
/// SQLite database. Changes become visible together by `commit`, or not at all.
class MapFile {
 public:
  using WarningHandler = std::function<void(const std::string&)>;

  enum class Mode {
    kRead,    ///< other processes may read and write
    kExtend,  ///< other processes may read
    kCreate   ///< a new file, or in place of an older map
  };

  /// @throws FileError if the file cannot be opened, or another process writes it; DataError if it
  /// is no map, of an unknown version, or damaged.
  MapFile(const std::filesystem::path& path, Mode mode);

  /// Makes a new file with the content of another one.
  MapFile(const std::filesystem::path& path, const std::filesystem::path& source);

  ~MapFile();
  MapFile(const MapFile&) = delete;
  MapFile& operator=(const MapFile&) = delete;

  const std::vector<MapSession>& sessions() const { return sessions_; }
  std::size_t keyframes() const;
  std::size_t loops() const;  ///< accepted ones
  std::size_t points(std::uint32_t session) const;

  /// Keyframes, poses and loops of all sessions. Keyframes that are damaged have only their pose.
  /// @param warn  called for each of these
  GlobalMapContent content(const WarningHandler& warn) const;

  /// Static map of a session. Damaged parts are left out.
  /// @param warn  called for each of these
  StampedMap surfaces(std::uint32_t session, const WarningHandler& warn) const;

  /// Reads everything.
  /// @returns all faults
  std::vector<std::string> check() const;

  /// Adds the next session.
  /// @param records  those of this session are added
  void add_session(const MapSession& session, const StampedMap& surfaces,
                   const std::deque<KeyframeRecord>& records);

  /// Replaces the poses of all keyframes, and all loops.
  void set_graph(const std::vector<Eigen::Isometry3d>& poses, const std::vector<Loop>& loops);

  /// Makes all changes permanent. The last call.
  /// @throws FileError if the disk is full; then the file is as before.
  void commit();

 private:
  void write_partial();
  std::size_t count_of(const std::string& table) const;
  void read_sessions();

  std::filesystem::path path_;
  std::optional<MapClaim> claim_;             ///< of `path_`, if it is written
  std::unique_ptr<SqliteDatabase> replaced_;  ///< the map at `path_`, locked until it is replaced
  std::optional<TemporaryPath> written_;      ///< the file that is renamed to `path_`, if any
  std::optional<TemporaryPath> journal_;      ///< SQLite's beside it
  std::unique_ptr<SqliteDatabase> database_;  ///< closed before its files are removed
  std::vector<MapSession> sessions_;
};

/// Whether a file begins as a map file does, of any version.
bool is_map_file(const std::filesystem::path& path);

/// Writes a file anew without the space that earlier changes left.
void compact_map_file(const std::filesystem::path& path);

}  // namespace mms
