// Map files: round trips, damage, locks, full disks and kills.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <numeric>
#include <thread>

#include "mms/core/error.hpp"
#include "mms/map_file/map_coding.hpp"
#include "mms/map_file/map_composition.hpp"
#include "tests/map_file/stored_visit.hpp"

namespace mms {
namespace {

using namespace testing;
using Mode = MapFile::Mode;

std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string message_of(const std::filesystem::path& path, Mode mode) {
  try {
    MapFile(path, mode);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// Whether another process finds a lock of a file.
bool is_locked(const std::filesystem::path& path) {
  const pid_t child = fork();
  if (child == 0) {
    const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
    struct flock lock = {};
    lock.l_type = F_WRLCK;
    lock.l_whence = SEEK_SET;
    const bool is_known = file >= 0 && fcntl(file, F_GETLK, &lock) == 0;
    _exit(is_known && lock.l_type != F_UNLCK ? 0 : 1);
  }
  int status = 0;
  return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// Adds a second session to a file.
void extend(const std::filesystem::path& path) {
  MapFile file(path, Mode::kExtend);
  GlobalMap map = empty_map();
  map.restore(file.content(refuse), MapUse::kExtend);
  drive(map, 4, 12, other_world());
  file.add_session(some_session("second"), some_surfaces(map, 3000, 2), map.records());
  file.set_graph(map.poses(), map.loops());
  file.commit();
}

TEST(MapFile, KeepsEverything) {
  const TempFolder folder;
  GlobalMap map = empty_map();
  drive(map, 0, kSteps, Eigen::Isometry3d::Identity());
  drive(map, kSteps - 1, kSteps - 6, Eigen::Isometry3d::Identity());
  {
    MapFile file(folder.path() / "a", Mode::kCreate);
    file.add_session(some_session("first"), some_surfaces(map, 100, 1), map.records());
    file.set_graph(map.poses(), map.loops());
    file.commit();
  }
  const MapFile file(folder.path() / "a", Mode::kRead);
  ASSERT_EQ(file.sessions().size(), 1U);
  EXPECT_EQ(file.sessions()[0].name, "first");
  EXPECT_EQ(file.sessions()[0].camera.width, 320);
  const GlobalMapContent content = file.content(refuse);
  ASSERT_EQ(content.records.size(), map.records().size());
  for (std::size_t i = 0; i < content.records.size(); ++i) {
    const KeyframeRecord& read = content.records[i];
    const KeyframeRecord& saved = map.records()[i];
    EXPECT_EQ(read.stamp, saved.stamp);
    EXPECT_EQ(read.keypoints.descriptors, saved.keypoints.descriptors);
    EXPECT_EQ(read.keypoints.points, saved.keypoints.points);
    EXPECT_EQ(read.keypoints.pixels, saved.keypoints.pixels);
    ASSERT_EQ(read.features.planes.size(), saved.features.planes.size());
    ASSERT_EQ(read.features.edges.size(), saved.features.edges.size());
    EXPECT_EQ(read.features.planes.back().normal, saved.features.planes.back().normal);
    EXPECT_EQ(read.view.depth_mm.pixels(), saved.view.depth_mm.pixels());
    EXPECT_EQ(read.view.camera, saved.view.camera);
    EXPECT_FALSE(read.view.gray.empty());
    EXPECT_EQ(read.view.gray.pixels(), saved.view.gray.pixels());
    EXPECT_LT((content.poses[i].matrix() - map.poses()[i].matrix()).norm(), 1e-12);
  }
  ASSERT_EQ(content.loops.size(), map.loops().size());
  ASSERT_FALSE(content.loops.empty());
  EXPECT_EQ(content.loops.back().outcome, map.loops().back().outcome);
  EXPECT_EQ(content.loops.back().information, map.loops().back().information);
}

/// Points to a part of the voxel, and stamps to 10 ms, in another order.
TEST(MapFile, KeepsSurfacesToAFractionOfTheVoxel) {
  const TempFolder folder;
  GlobalMap map = empty_map();
  drive(map, 0, kSteps, Eigen::Isometry3d::Identity());
  StampedMap saved = some_surfaces(map, 5000, 1);
  for (int i = 0; i < 100; ++i) saved.cloud.normals[static_cast<std::size_t>(50 * i)].setZero();
  {
    MapFile file(folder.path() / "a", Mode::kCreate);
    file.add_session(some_session("first"), saved, map.records());
    file.set_graph(map.poses(), map.loops());
    file.commit();
  }
  const StampedMap read = MapFile(folder.path() / "a", Mode::kRead).surfaces(0, refuse);
  ASSERT_EQ(read.cloud.size(), saved.cloud.size());
  const float quantum = 0.02F / 32.0F;
  const auto by_position = [](const MapCloud& cloud) {
    std::vector<std::size_t> order(cloud.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return cloud.points[a].x() < cloud.points[b].x();
    });
    return order;
  };
  const std::vector<std::size_t> order = by_position(read.cloud);
  for (std::size_t i = 0; i < saved.cloud.size(); ++i) {
    const Eigen::Vector3f& point = saved.cloud.points[i];
    const auto first =
        std::lower_bound(order.begin(), order.end(), point.x() - quantum,
                         [&](std::size_t k, float x) { return read.cloud.points[k].x() < x; });
    const auto found = std::find_if(first, order.end(), [&](std::size_t k) {
      return (read.cloud.points[k] - point).cwiseAbs().maxCoeff() < 0.51F * quantum;
    });
    ASSERT_NE(found, order.end()) << i;
    EXPECT_LT((read.cloud.normals[*found] - saved.cloud.normals[i]).norm(), 0.02F);
    EXPECT_EQ(read.cloud.colors[*found].r, saved.cloud.colors[i].r);
    EXPECT_EQ(read.cloud.observations[*found], saved.cloud.observations[i]);
    EXPECT_LT(std::abs(to_seconds(read.stamps[*found] - saved.stamps[i])), 0.0101);
  }
}

TEST(MapFile, AddsASessionInPlace) {
  const TempFolder folder;
  write_first_session(folder.path() / "a");
  extend(folder.path() / "a");
  const MapFile file(folder.path() / "a", Mode::kRead);
  EXPECT_EQ(file.sessions().size(), 2U);
  EXPECT_EQ(file.keyframes(), kSteps + 8U);
  EXPECT_TRUE(file.check().empty());
  EXPECT_EQ(joined_sessions(file.content(refuse)).size(), 2U);
}

TEST(MapFile, WithoutCommitNothingChanges) {
  const TempFolder folder;
  write_first_session(folder.path() / "a");
  const std::string before = read_bytes(folder.path() / "a");
  {
    MapFile file(folder.path() / "a", Mode::kExtend);
    file.add_session(some_session("second"), {}, {});
    const MapFile unused(folder.path() / "b", Mode::kCreate);
  }
  EXPECT_EQ(read_bytes(folder.path() / "a"), before);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "b"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "b.partial"));
}

TEST(MapFile, TheSecondWriterIsRefusedAndReadersAreWelcome) {
  const TempFolder folder;
  write_first_session(folder.path() / "a");
  const MapFile writer(folder.path() / "a", Mode::kExtend);
  EXPECT_NE(message_of(folder.path() / "a", Mode::kExtend).find("this program"), std::string::npos);
  const MapFile reader(folder.path() / "a", Mode::kRead);
  EXPECT_TRUE(reader.check().empty());
  EXPECT_TRUE(is_map_file(folder.path() / "a"));
  EXPECT_TRUE(is_locked(folder.path() / "a"));
}

TEST(MapFile, AMapThatARunExtendsIsNotReplaced) {
  const TempFolder folder;
  write_first_session(folder.path() / "a");
  {
    const MapFile writer(folder.path() / "a", Mode::kExtend);
    EXPECT_NE(message_of(folder.path() / "a", Mode::kCreate).find("this program"),
              std::string::npos);
    EXPECT_THROW(compact_map_file(folder.path() / "a"), FileError);
  }
  const MapFile replacing(folder.path() / "a", Mode::kCreate);
  EXPECT_NE(message_of(folder.path() / "a", Mode::kExtend).find("this program"), std::string::npos);
}

TEST(MapFile, AReaderSeesTheSessionsThatWereThere) {
  const TempFolder folder;
  write_first_session(folder.path() / "a");
  const MapFile reader(folder.path() / "a", Mode::kRead);
  const std::size_t before = reader.content(refuse).loops.size();
  extend(folder.path() / "a");
  EXPECT_TRUE(reader.check().empty());
  const GlobalMapContent content = reader.content(refuse);
  EXPECT_EQ(content.records.size(), static_cast<std::size_t>(kSteps));
  EXPECT_EQ(content.poses.size(), static_cast<std::size_t>(kSteps));
  EXPECT_EQ(content.loops.size(), before);
}

TEST(MapFile, TwoRunsDoNotMakeOneFile) {
  const TempFolder folder;
  {
    const MapFile first(folder.path() / "a", Mode::kCreate);
    EXPECT_NE(message_of(folder.path() / "a", Mode::kCreate).find("this program"),
              std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "a.partial"));
  }
  write_bytes(folder.path() / "a.partial", "what a killed run left");
  write_first_session(folder.path() / "a");
  EXPECT_TRUE(MapFile(folder.path() / "a", Mode::kRead).check().empty());
}

TEST(MapFile, SessionsWithoutKeyframesAreDamage) {
  const TempFolder folder;
  { MapFile(folder.path() / "none", Mode::kCreate).commit(); }
  write_first_session(folder.path() / "one");
  {
    MapFile file(folder.path() / "one", Mode::kExtend);
    file.add_session(some_session("second"), {}, {});
    file.commit();
  }
  for (const char* name : {"none", "one"}) {
    const MapFile file(folder.path() / name, Mode::kRead);
    EXPECT_EQ(file.check().size(), 1U) << name;
    EXPECT_THROW(file.content(refuse), DataError) << name;
  }
}

TEST(MapFile, OtherFilesAreRefusedByName) {
  const TempFolder folder;
  EXPECT_NE(message_of(folder.path() / "a", Mode::kRead).find("does not exist"), std::string::npos);
  write_bytes(folder.path() / "a", "a text");
  EXPECT_NE(message_of(folder.path() / "a", Mode::kRead).find("is no map"), std::string::npos);
  EXPECT_NE(message_of(folder.path() / "a", Mode::kCreate).find("is no map"), std::string::npos);
  EXPECT_EQ(read_bytes(folder.path() / "a"), "a text");
  sqlite3* other = nullptr;
  ASSERT_EQ(sqlite3_open((folder.path() / "b").c_str(), &other), SQLITE_OK);
  sqlite3_exec(other, "CREATE TABLE sessions (x)", nullptr, nullptr, nullptr);
  sqlite3_close(other);
  EXPECT_NE(message_of(folder.path() / "b", Mode::kRead).find("is no map"), std::string::npos);
  write_first_session(folder.path() / "c");
  std::string bytes = read_bytes(folder.path() / "c");
  bytes[63] = 9;
  write_bytes(folder.path() / "c", bytes);
  EXPECT_NE(message_of(folder.path() / "c", Mode::kRead).find("version 9"), std::string::npos);
}

/// Views of version 1 have no grey values.
TEST(MapFile, AMapOfAnEarlierVersionIsReadAndExtended) {
  const TempFolder folder;
  const std::filesystem::path path = folder.path() / "a";
  GlobalMap map = empty_map();
  drive(map, 0, kSteps, Eigen::Isometry3d::Identity());
  std::deque<KeyframeRecord> records = map.records();
  for (KeyframeRecord& record : records) record.view.gray = {};
  {
    MapFile file(path, Mode::kCreate);
    file.add_session(some_session("first"), some_surfaces(map, 10, 1), records);
    file.set_graph(map.poses(), map.loops());
    file.commit();
  }
  std::string bytes = read_bytes(path);
  bytes[63] = 1;
  write_bytes(path, bytes);
  {
    MapFile file(path, Mode::kExtend);
    const GlobalMapContent content = file.content(refuse);
    ASSERT_EQ(content.records.size(), records.size());
    EXPECT_TRUE(content.records.back().view.gray.empty());
    EXPECT_EQ(content.records.back().view.depth_mm.pixels(), records.back().view.depth_mm.pixels());
    file.set_graph(content.poses, content.loops);
    file.commit();
  }
  EXPECT_EQ(read_bytes(path)[63], 2);
}

TEST(MapFile, ABrokenKeyframeIsNamedAndTheRestIsRead) {
  const TempFolder folder;
  write_first_session(folder.path() / "a");
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open((folder.path() / "a").c_str(), &database), SQLITE_OK);
  const char* damage =
      "UPDATE keyframe_data SET data = substr(data, 1, 1000) || x'0123' || substr(data, 1003) "
      "WHERE keyframe = 7; UPDATE submaps SET data = x'00' WHERE number = 0";
  ASSERT_EQ(sqlite3_exec(database, damage, nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(database);
  const MapFile file(folder.path() / "a", Mode::kRead);
  const std::vector<std::string> faults = file.check();
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_NE(faults[0].find("keyframe 7"), std::string::npos) << faults[0];
  std::size_t warnings = 0;
  const GlobalMapContent content = file.content([&](const std::string&) { ++warnings; });
  EXPECT_EQ(warnings, 1U);
  EXPECT_TRUE(content.records[7].is_pose_only());
  EXPECT_FALSE(content.records[8].is_pose_only());
}

/// Whatever the bytes are, there is a message or a map, and no crash.
TEST(MapFile, DamagedBytesAreNeverFatal) {
  const TempFolder folder;
  write_first_session(folder.path() / "a");
  const std::string bytes = read_bytes(folder.path() / "a");
  RandomStream random(3);
  int refused = 0;
  int faulty = 0;
  for (int i = 0; i < 150; ++i) {
    std::string damaged = bytes;
    // Half of the damage is in the first pages, which describe the tables.
    const std::size_t range = i % 2 == 0 ? damaged.size() : 40'000;
    for (std::uint64_t n = random.below(20) + 1; n > 0; --n) {
      damaged[random.below(range)] = static_cast<char>(random.below(256));
    }
    if (i % 5 == 0) damaged.resize(random.below(damaged.size()));
    write_bytes(folder.path() / "b", damaged);
    try {
      const MapFile file(folder.path() / "b", Mode::kRead);
      faulty += !file.check().empty();
      const GlobalMapContent content = file.content([](const std::string&) {});
      composed_map(file, content, [](const std::string&) {});
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 20);
  EXPECT_GT(faulty, 20);
}

/// Runs `work` in another process. @returns its status
template <class Work>
int in_process(const Work& work, int kill_after_us = -1) {
  const pid_t child = fork();
  if (child == 0) {
    try {
      work();
      _exit(0);
    } catch (const Error&) {
      _exit(3);
    } catch (...) {
      _exit(4);
    }
  }
  if (kill_after_us >= 0) {
    std::this_thread::sleep_for(std::chrono::microseconds(kill_after_us));
    kill(child, SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

/// What `extend` writes, made before the processes that are killed.
struct Extension {
  GlobalMap map = empty_map();
  StampedMap surfaces;

  explicit Extension(const std::filesystem::path& path) {
    map.restore(MapFile(path, Mode::kRead).content(refuse), MapUse::kExtend);
    drive(map, 4, 12, other_world());
    surfaces = some_surfaces(map, 100'000, 2);
  }
  void write(const std::filesystem::path& path) const {
    MapFile file(path, Mode::kExtend);
    file.add_session(some_session("second"), surfaces, map.records());
    file.set_graph(map.poses(), map.loops());
    file.commit();
  }
};

TEST(MapFile, KilledAtAnyTimeItIsOldOrNew) {
  const TempFolder folder;
  write_first_session(folder.path() / "first");
  const Extension extension(folder.path() / "first");
  const auto start = std::chrono::steady_clock::now();
  std::filesystem::copy_file(folder.path() / "first", folder.path() / "a");
  extension.write(folder.path() / "a");
  const std::chrono::duration<double, std::micro> whole = std::chrono::steady_clock::now() - start;
  std::array<int, 3> found{};
  for (int i = 0; i < 30; ++i) {
    std::filesystem::remove(folder.path() / "a-journal");
    std::filesystem::copy_file(folder.path() / "first", folder.path() / "a",
                               std::filesystem::copy_options::overwrite_existing);
    in_process([&] { extension.write(folder.path() / "a"); },
               static_cast<int>(whole.count() * i / 25.0));
    const MapFile file(folder.path() / "a", Mode::kRead);
    EXPECT_TRUE(file.check().empty());
    ++found[file.sessions().size()];
  }
  EXPECT_EQ(found[1] + found[2], 30);
  EXPECT_GT(found[1], 0);
}

TEST(MapFile, AFullDiskLeavesTheOldMap) {
  const TempFolder folder;
  write_first_session(folder.path() / "a");
  const std::string before = read_bytes(folder.path() / "a");
  const Extension extension(folder.path() / "a");
  const int status = in_process([&] {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{before.size() + 100'000, before.size() + 100'000};
    setrlimit(RLIMIT_FSIZE, &limit);
    extension.write(folder.path() / "a");
  });
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 3);
  const MapFile file(folder.path() / "a", Mode::kRead);
  EXPECT_EQ(file.sessions().size(), 1U);
  EXPECT_TRUE(file.check().empty());
}

TEST(MapFile, CompactingKeepsTheContent) {
  const TempFolder folder;
  write_first_session(folder.path() / "a");
  extend(folder.path() / "a");
  const MapCloud before = [&] {
    const MapFile file(folder.path() / "a", Mode::kRead);
    return composed_map(file, file.content(refuse), refuse);
  }();
  compact_map_file(folder.path() / "a");
  const MapFile file(folder.path() / "a", Mode::kRead);
  EXPECT_TRUE(file.check().empty());
  EXPECT_EQ(composed_map(file, file.content(refuse), refuse).points, before.points);
}

TEST(MapFile, TheMapOfOneSessionIsItsStaticMap) {
  const TempFolder folder;
  write_first_session(folder.path() / "a");
  const MapFile file(folder.path() / "a", Mode::kRead);
  EXPECT_EQ(composed_map(file, file.content(refuse), refuse).points,
            file.surfaces(0, refuse).cloud.points);
}

TEST(MapFile, CompactingKeepsALink) {
  const TempFolder folder;
  write_first_session(folder.path() / "a");
  extend(folder.path() / "a");
  std::filesystem::create_symlink(folder.path() / "a", folder.path() / "link");
  const auto before = std::filesystem::file_size(folder.path() / "a");
  compact_map_file(folder.path() / "link");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link"));
  EXPECT_LE(std::filesystem::file_size(folder.path() / "a"), before);
  EXPECT_TRUE(MapFile(folder.path() / "a", Mode::kRead).check().empty());
}

TEST(MapFile, APointWithoutObservationsIsDamage) {
  StampedMap map;
  map.cloud.points = {{1.0F, 2.0F, 3.0F}};
  map.cloud.normals = {{0.0F, 0.0F, 1.0F}};
  map.cloud.colors = {{}};
  map.cloud.observations = {0};
  map.stamps = {Timestamp(1)};
  StampedMap read;
  EXPECT_THROW(decode_surfaces(encode_surfaces(map, 0.02, {0}), "a", read), DataError);
  EXPECT_EQ(read.cloud.size(), 0U);
}

}  // namespace
}  // namespace mms
