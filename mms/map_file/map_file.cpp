#include "mms/map_file/map_file.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/map_file/map_coding.hpp"
#include "mms/map_file/map_schema.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using Access = SqliteDatabase::Access;

/// [-]: keyframes of a submap: about 5 m.
constexpr std::size_t kSubmapKeyframes = 20;

/// The header of a database file: text, then numbers at given places. Of a map that this process
/// writes it was read before.
class FileHeader {
 public:
  explicit FileHeader(const fs::path& path) : is_claimed_(MapClaim::exists(path)) {
    if (is_claimed_) return;
    std::ifstream file(path, std::ios::binary);
    file.read(bytes_, sizeof bytes_);
    valid_ = file.gcount() == sizeof bytes_ && std::string_view(bytes_, 15) == "SQLite format 3";
  }
  bool is_map() const { return is_claimed_ || (valid_ && number(68) == kMapApplication); }
  std::int64_t version() const { return is_claimed_ ? kMapVersion : number(60); }

 private:
  std::int64_t number(std::size_t offset) const {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      value = value << 8U | static_cast<std::uint8_t>(bytes_[offset + i]);
    }
    return value;
  }

  bool is_claimed_;
  char bytes_[100]{};
  bool valid_ = false;
};

void check_header(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) {
    throw FileError(path.string(), "does not exist", "mms run DATA --save-map FILE makes a map");
  }
  if (!fs::is_regular_file(path, error)) throw FileError(path.string(), "is no file");
  const FileHeader header(path);
  if (!header.is_map()) {
    throw DataError(path.string(), "is no map of mms", "mms run DATA --save-map FILE makes one");
  }
  if (header.version() < kOldestMapVersion || header.version() > kMapVersion) {
    throw DataError(path.string(),
                    fmt::format("is a map of version {}, this program reads versions {} to {}",
                                header.version(), kOldestMapVersion, kMapVersion),
                    "use the program that made it, see mms --version");
  }
}

std::unique_ptr<SqliteDatabase> open_existing(const fs::path& path, Access access) {
  check_header(path);
  auto database = std::make_unique<SqliteDatabase>(path, access);
  // Views could compute without end.
  SqliteStatement tables = database->prepare(
      "SELECT count(*) FROM sqlite_schema WHERE type = 'table' AND sql LIKE 'CREATE TABLE%' AND "
      "name IN ('sessions', 'keyframes', 'poses', 'keyframe_data', 'loops', 'submaps')");
  if (!tables.next() || tables.integer(0) != 6) {
    throw DataError(path.string(), "is damaged: tables of the map are missing");
  }
  return database;
}

fs::path partial_of(const fs::path& path) {
  return path.string() + ".partial";
}

fs::path journal_of(const fs::path& database) {
  return database.string() + "-journal";
}

/// Removes what a killed run left. @throws FileError if another run writes it
void remove_old_partial(const fs::path& path) {
  if (!fs::exists(path)) return;
  try {
    const SqliteDatabase unused(path, Access::kWrite);
  } catch (const DataError&) {  // killed before it was a database
  }
  std::error_code ignored;
  fs::remove(path, ignored);
  fs::remove(journal_of(path), ignored);
}

/// Makes all reads of its lifetime see the same state of the database.
class Snapshot {
 public:
  explicit Snapshot(const SqliteDatabase& database) : database_(database) {
    database_.execute("SAVEPOINT snapshot");
  }
  ~Snapshot() {
    try {
      database_.execute("RELEASE snapshot");
    } catch (const Error&) {  // a fault of the database ended it
    }
  }
  Snapshot(const Snapshot&) = delete;
  Snapshot& operator=(const Snapshot&) = delete;

 private:
  const SqliteDatabase& database_;
};

/// Removes the sessions from `end` on.
void remove_sessions(GlobalMapContent& content, std::size_t end) {
  while (!content.records.empty() && content.records.back().session >= end) {
    content.records.pop_back();
  }
  content.poses.resize(content.records.size());
  std::erase_if(content.loops,
                [&](const Loop& loop) { return loop.query >= content.records.size(); });
}

/// A place for a new map, that has none or an older one.
void check_target(const fs::path& path) {
  std::error_code error;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error)) {
    throw FileError(path.string(), "cannot be written: its folder does not exist");
  }
  if (fs::exists(path, error) && !is_map_file(path)) {
    throw FileError(path.string(), "exists and is no map of mms", "choose another file");
  }
}

void bind_pose(SqliteStatement& statement, int first, const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d& t = pose.translation();
  const Eigen::Quaterniond q(pose.linear());
  for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) {
    statement.bind(first++, value);
  }
}

/// Names of the columns of a pose.
constexpr std::string_view kPose = "x, y, z, qx, qy, qz, qw";

Eigen::Isometry3d pose_of(const SqliteStatement& row, int first, const std::string& where) {
  const auto value = [&](int i) { return row.real(first + i); };
  const Eigen::Vector3d t(value(0), value(1), value(2));
  const Eigen::Quaterniond q(value(6), value(3), value(4), value(5));
  const double norm = q.norm();
  if (!t.allFinite() || !(norm > 0.99 && norm < 1.01)) {
    throw DataError(where, "is damaged: its pose is none");
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  pose.translation() = t;
  return pose;
}

std::optional<LoopOutcome> outcome_of(std::string_view name) {
  for (int i = 0; i < kLoopOutcomes; ++i) {
    const auto outcome = static_cast<LoopOutcome>(i);
    if (name == to_string(outcome)) return outcome;
  }
  return std::nullopt;
}

std::string_view bytes_of(const Matrix6d& matrix) {
  return {reinterpret_cast<const char*>(matrix.data()), sizeof(double) * 36};
}

Loop loop_of(const SqliteStatement& row, std::size_t keyframes, const std::string& where) {
  Loop loop;
  loop.candidate = static_cast<std::size_t>(row.integer(0));
  loop.query = static_cast<std::size_t>(row.integer(1));
  const auto outcome = outcome_of(row.text(2));
  const std::string_view information = row.blob(13);
  const bool is_valid = outcome && loop.candidate < loop.query && loop.query < keyframes &&
                        information.size() == bytes_of(loop.information).size();
  if (!is_valid) throw DataError(where, "is damaged: no loop of its keyframes");
  loop.outcome = *outcome;
  loop.inliers = static_cast<int>(row.integer(3));
  loop.overlap = row.real(4);
  loop.contradiction = row.real(5);
  loop.T_candidate_query = pose_of(row, 6, where);
  std::memcpy(loop.information.data(), information.data(), information.size());
  if (!loop.information.allFinite()) throw DataError(where, "is damaged: its information is none");
  return loop;
}

/// Indices of the points by the submap of their last measurement.
std::vector<std::vector<std::uint32_t>> divided(const StampedMap& surfaces,
                                                const std::vector<Timestamp>& keyframes) {
  std::vector<std::vector<std::uint32_t>> submaps(keyframes.size() / kSubmapKeyframes + 1);
  for (std::size_t i = 0; i < surfaces.stamps.size(); ++i) {
    const auto next = std::upper_bound(keyframes.begin(), keyframes.end(), surfaces.stamps[i]);
    const auto since = static_cast<std::size_t>(next - keyframes.begin());
    submaps[(since > 0 ? since - 1 : 0) / kSubmapKeyframes].push_back(
        static_cast<std::uint32_t>(i));
  }
  return submaps;
}

}  // namespace

bool is_map_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error) && FileHeader(path).is_map();
}

MapFile::MapFile(const fs::path& path, Mode mode) : path_(path) {
  if (mode == Mode::kCreate) {
    write_partial();
    database_ = std::make_unique<SqliteDatabase>(written_->path(), Access::kCreate);
    database_->execute(fmt::format("PRAGMA application_id = {};{}", kMapApplication, kMapSchema));
    return;
  }
  if (mode == Mode::kExtend) {
    check_header(path);
    claim_.emplace(path);
  }
  database_ = open_existing(path, mode == Mode::kRead ? Access::kRead : Access::kWrite);
  read_sessions();
}

MapFile::MapFile(const fs::path& path, const fs::path& source) : path_(path) {
  const auto from = open_existing(source, Access::kRead);
  write_partial();
  from->execute("PRAGMA query_only = 0");  // VACUUM INTO writes, but another file
  SqliteStatement copy = from->prepare("VACUUM INTO ?1");
  copy.bind_text(1, written_->path().string()).run();
  database_ = open_existing(written_->path(), Access::kWrite);
  read_sessions();
}

MapFile::~MapFile() = default;

/// Prepares a new file beside the place of the map. A map that is there stays as it is until then.
void MapFile::write_partial() {
  check_target(path_);
  std::error_code error;
  if (fs::exists(path_, error)) path_ = fs::canonical(path_);  // a link stays one
  claim_.emplace(path_);
  // Last: closing any other descriptor of the file ends the lock (POSIX).
  if (fs::exists(path_)) {
    try {
      replaced_ = std::make_unique<SqliteDatabase>(path_, Access::kWrite);
    } catch (const DataError&) {  // a damaged one
    }
  }
  const fs::path partial = partial_of(path_);
  remove_old_partial(partial);
  written_.emplace(partial);
  journal_.emplace(journal_of(partial));
}

void MapFile::read_sessions() {
  SqliteStatement rows = database_->prepare(
      "SELECT number, name, program, settings, frames, begin_stamp, end_stamp, voxel_size, width, "
      "height, fx, fy, cx, cy FROM sessions ORDER BY number");
  while (rows.next()) {
    if (rows.integer(0) != static_cast<std::int64_t>(sessions_.size())) {
      throw DataError(path_.string(), "is damaged: its sessions are not numbered from 0");
    }
    MapSession& session = sessions_.emplace_back();
    session.name = rows.text(1);
    session.program = rows.text(2);
    session.settings = rows.text(3);
    session.frames = rows.integer(4);
    session.begin = Timestamp(rows.integer(5));
    session.end = Timestamp(rows.integer(6));
    session.voxel_size = rows.real(7);
    session.camera.width = static_cast<int>(rows.integer(8));
    session.camera.height = static_cast<int>(rows.integer(9));
    session.camera.fx = rows.real(10);
    session.camera.fy = rows.real(11);
    session.camera.cx = rows.real(12);
    session.camera.cy = rows.real(13);
    if (!(session.voxel_size > 0.0)) {
      throw DataError(path_.string(), "is damaged: a session has no voxel size");
    }
  }
}

std::size_t MapFile::keyframes() const {
  return count_of("keyframes");
}

std::size_t MapFile::loops() const {
  SqliteStatement count = database_->prepare("SELECT count(*) FROM loops WHERE outcome = ?1");
  count.bind_text(1, to_string(LoopOutcome::kAccepted)).next();
  return static_cast<std::size_t>(count.integer(0));
}

std::size_t MapFile::points(std::uint32_t session) const {
  SqliteStatement points = database_->prepare("SELECT points FROM sessions WHERE number = ?1");
  points.bind(1, std::int64_t{session});
  points.next();
  return static_cast<std::size_t>(points.integer(0));
}

std::size_t MapFile::count_of(const std::string& table) const {
  SqliteStatement count = database_->prepare("SELECT count(*) FROM " + table);
  count.next();
  return static_cast<std::size_t>(count.integer(0));
}

GlobalMapContent MapFile::content(const WarningHandler& warn) const {
  const Snapshot snapshot(*database_);
  // More than those that are known, if a run added some meanwhile.
  const std::size_t sessions = count_of("sessions");
  GlobalMapContent content;
  SqliteStatement rows = database_->prepare(fmt::format(
      "SELECT number, session, stamp, after_lost, {} FROM keyframes ORDER BY number", kPose));
  SqliteStatement data = database_->prepare("SELECT data FROM keyframe_data WHERE keyframe = ?1");
  while (rows.next()) {
    const std::size_t number = content.records.size();
    const std::string where = fmt::format("{}: keyframe {}", path_.string(), number);
    KeyframeRecord record;
    const std::int64_t session = rows.integer(1);
    const std::int64_t least = number == 0 ? 0 : content.records.back().session;
    if (rows.integer(0) != static_cast<std::int64_t>(number) || session < least ||
        session > (number == 0 ? 0 : least + 1) || session >= static_cast<std::int64_t>(sessions)) {
      throw DataError(where, "is damaged: it is out of order");
    }
    record.session = static_cast<std::uint32_t>(session);
    record.stamp = Timestamp(rows.integer(2));
    record.after_lost = rows.integer(3) != 0;
    record.T_world_sensor = Transform<World, Sensor>(pose_of(rows, 4, where));
    data.reset();
    try {
      if (!data.bind(1, rows.integer(0)).next()) throw DataError(where, "has no data");
      decode_keyframe(data.blob(0), where, record);
    } catch (const DataError& error) {
      warn(error.what());
      record.keypoints = {};
      record.features = {};
      record.view = {};
      record.scan = {};
    }
    content.records.push_back(std::move(record));
  }
  const std::size_t found = content.records.empty() ? 0 : content.records.back().session + 1;
  if (found == 0 || found != sessions) {
    throw DataError(path_.string(), fmt::format("is damaged: it has keyframes of {} sessions of {}",
                                                found, sessions));
  }
  SqliteStatement poses =
      database_->prepare(fmt::format("SELECT keyframe, {} FROM poses ORDER BY keyframe", kPose));
  while (poses.next()) {
    const std::string where = fmt::format("{}: pose {}", path_.string(), content.poses.size());
    if (poses.integer(0) != static_cast<std::int64_t>(content.poses.size())) {
      throw DataError(where, "is damaged: it is out of order");
    }
    content.poses.push_back(pose_of(poses, 1, where));
  }
  if (content.poses.size() != content.records.size()) {
    throw DataError(path_.string(), fmt::format("is damaged: {} poses of {} keyframes",
                                                content.poses.size(), content.records.size()));
  }
  SqliteStatement loops = database_->prepare(fmt::format(
      "SELECT earlier, later, outcome, inliers, overlap, contradiction, {}, information FROM loops "
      "ORDER BY number",
      kPose));
  while (loops.next()) {
    const std::string where = fmt::format("{}: loop {}", path_.string(), content.loops.size());
    content.loops.push_back(loop_of(loops, content.records.size(), where));
  }
  remove_sessions(content, sessions_.size());
  return content;
}

StampedMap MapFile::surfaces(std::uint32_t session, const WarningHandler& warn) const {
  StampedMap surfaces;
  SqliteStatement rows =
      database_->prepare("SELECT number, data FROM submaps WHERE session = ?1 ORDER BY number");
  rows.bind(1, std::int64_t{session});
  while (rows.next()) {
    const std::string where =
        fmt::format("{}: submap {} of session {}", path_.string(), rows.integer(0), session);
    try {
      decode_surfaces(rows.blob(1), where, surfaces);
    } catch (const DataError& error) {
      warn(error.what());
    }
  }
  return surfaces;
}

std::vector<std::string> MapFile::check() const {
  std::vector<std::string> faults;
  const auto note = [&](const std::string& fault) { faults.push_back(fault); };
  const auto attempt = [&](const auto& read) {
    try {
      read();
    } catch (const Error& error) {
      note(error.what());
    }
  };
  attempt([&] {
    SqliteStatement rows = database_->prepare("PRAGMA integrity_check(10)");
    while (rows.next()) {
      if (rows.text(0) != "ok") note(path_.string() + ": is damaged: " + std::string(rows.text(0)));
    }
  });
  attempt([&] { content(note); });
  for (std::uint32_t i = 0; i < sessions_.size(); ++i) attempt([&] { surfaces(i, note); });
  return faults;
}

void MapFile::add_session(const MapSession& session, const StampedMap& surfaces,
                          const std::deque<KeyframeRecord>& records) {
  const auto number = static_cast<std::int64_t>(sessions_.size());
  SqliteStatement row = database_->prepare(
      "INSERT INTO sessions VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, "
      "?15)");
  row.bind(1, number).bind_text(2, session.name).bind_text(3, session.program);
  row.bind_text(4, session.settings).bind(5, session.frames);
  row.bind(6, session.begin.nanoseconds()).bind(7, session.end.nanoseconds());
  row.bind(8, session.voxel_size).bind(9, static_cast<std::int64_t>(surfaces.cloud.size()));
  row.bind(10, std::int64_t{session.camera.width}).bind(11, std::int64_t{session.camera.height});
  row.bind(12, session.camera.fx).bind(13, session.camera.fy);
  row.bind(14, session.camera.cx).bind(15, session.camera.cy).run();
  sessions_.push_back(session);

  SqliteStatement keyframe = database_->prepare(
      "INSERT INTO keyframes VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11)");
  SqliteStatement data = database_->prepare("INSERT INTO keyframe_data VALUES (?1, ?2)");
  std::vector<Timestamp> stamps;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const KeyframeRecord& record = records[i];
    if (record.session != static_cast<std::uint32_t>(number)) continue;
    const auto id = static_cast<std::int64_t>(i);
    stamps.push_back(record.stamp);
    keyframe.bind(1, id).bind(2, number).bind(3, record.stamp.nanoseconds());
    keyframe.bind(4, std::int64_t{record.after_lost});
    bind_pose(keyframe, 5, record.T_world_sensor.isometry());
    keyframe.run();
    data.bind(1, id).bind_blob(2, encode_keyframe(record)).run();
  }

  SqliteStatement submap = database_->prepare("INSERT INTO submaps VALUES (?1, ?2, ?3, ?4)");
  const std::vector<std::vector<std::uint32_t>> submaps = divided(surfaces, stamps);
  for (std::size_t i = 0; i < submaps.size(); ++i) {
    submap.bind(1, number).bind(2, static_cast<std::int64_t>(i));
    submap.bind(3, static_cast<std::int64_t>(submaps[i].size()));
    submap.bind_blob(4, encode_surfaces(surfaces, session.voxel_size, submaps[i])).run();
  }
}

void MapFile::set_graph(const std::vector<Eigen::Isometry3d>& poses,
                        const std::vector<Loop>& loops) {
  database_->execute("DELETE FROM poses; DELETE FROM loops");
  SqliteStatement pose =
      database_->prepare("INSERT INTO poses VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)");
  for (std::size_t i = 0; i < poses.size(); ++i) {
    pose.bind(1, static_cast<std::int64_t>(i));
    bind_pose(pose, 2, poses[i]);
    pose.run();
  }
  SqliteStatement row = database_->prepare(
      "INSERT INTO loops VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, "
      "?15)");
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const Loop& loop = loops[i];
    row.bind(1, static_cast<std::int64_t>(i)).bind(2, static_cast<std::int64_t>(loop.candidate));
    row.bind(3, static_cast<std::int64_t>(loop.query)).bind_text(4, to_string(loop.outcome));
    row.bind(5, std::int64_t{loop.inliers}).bind(6, loop.overlap).bind(7, loop.contradiction);
    bind_pose(row, 8, loop.T_candidate_query);
    row.bind_blob(15, bytes_of(loop.information)).run();
  }
}

void MapFile::commit() {
  database_->execute(fmt::format("PRAGMA user_version = {}; COMMIT", kMapVersion));
  database_.reset();
  if (!written_) return claim_.reset();
  std::error_code error;
  fs::rename(written_->path(), path_, error);
  if (error) throw FileError(path_.string(), "cannot be written: " + error.message());
  written_->release();
  written_.reset();
  replaced_.reset();
  claim_.reset();
}

void compact_map_file(const fs::path& path) {
  MapFile(path, path).commit();
}

}  // namespace mms
