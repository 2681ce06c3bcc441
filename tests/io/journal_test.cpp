#include "mms/io/journal/journal.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/io/journal/crc32.hpp"
#include "mms/io/journal/journal_reader.hpp"
#include "mms/io/journal/journal_record.hpp"
#include "mms/io/journal/journal_writer.hpp"
#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using namespace testing;  // NOLINT: helpers of the tests

const JournalHeader kHeader{"a recording", 0.02, 2};

MapChanges sample_changes(int seed) {
  MapChanges changes;
  changes.viewpoint = Eigen::Vector3f(0.5F, -1.25F, static_cast<float>(seed));
  changes.voxel_size = 0.02;
  changes.whole = seed % 2 == 1;
  changes.blocks = {{{-3, seed, 7}, 2, 1}, {{1, 2, 3}, 3, 0}};
  changes.voxels = {{511, 4, {1, 2, 3}, {-127, 0, 127}, {9, 8, 7}}};
  changes.erased = {{-1, -2, -3}, {seed, 0, 0}};
  return changes;
}

JournalFrame sample_frame(int index) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.rotate(Eigen::AngleAxisd(0.1 * index, Eigen::Vector3d::UnitY()));
  pose.pretranslate(Eigen::Vector3d(0.1 * index, 1.0 / 3.0, -2.0));
  JournalFrame frame;
  frame.stamp = Timestamp(1'000'000'007LL * index);
  frame.written = Timestamp(1'700'000'000'000'000'000LL + index);
  frame.T_world_sensor = Transform<World, Sensor>(pose);
  frame.status = index == 0 ? Status::kInitialized : Status::kTracking;
  frame.organised = true;
  frame.keyframe = index % 2 == 0;
  if (frame.keyframe) frame.map = sample_changes(index);
  return frame;
}

void expect_same(const JournalFrame& a, const JournalFrame& b) {
  EXPECT_EQ(a.stamp, b.stamp);
  EXPECT_EQ(a.written, b.written);
  EXPECT_EQ(a.T_world_sensor.isometry().matrix(), b.T_world_sensor.isometry().matrix());
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.keyframe, b.keyframe);
  EXPECT_EQ(a.organised, b.organised);
  EXPECT_EQ(a.map, b.map);
}

/// A journal of some frames, with the ends of its records.
struct Sample {
  std::string bytes = encode_header(kHeader);
  std::vector<std::size_t> ends = {bytes.size()};

  explicit Sample(int frames) {
    for (int i = 0; i < frames; ++i) {
      bytes += encode_frame(sample_frame(i));
      ends.push_back(bytes.size());
    }
  }

  /// Number of complete frames in the first `size` bytes.
  std::size_t complete_frames(std::size_t size) const {
    return static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), size) -
                                    ends.begin()) -
           1;
  }
};

/// Reads all frames, expects those of a sample and returns their number.
std::size_t count_frames(JournalReader& reader) {
  std::size_t count = 0;
  while (const std::optional<JournalFrame> frame = reader.next()) {
    expect_same(*frame, sample_frame(static_cast<int>(count)));
    ++count;
  }
  return count;
}

std::size_t frames_in(const fs::path& path) {
  JournalReader reader(path);
  return count_frames(reader);
}

TEST(Crc32, EqualsStandardValues) {
  EXPECT_EQ(crc32("123456789"), 0xCBF43926U);
  EXPECT_EQ(crc32(""), 0U);
}

TEST(Journal, RoundTrips) {
  const TempFolder folder;
  const fs::path path = folder.path() / "journal.bin";
  JournalWriter writer(path, kHeader);
  for (int i = 0; i < 5; ++i) {
    writer.append(sample_frame(i));
    EXPECT_EQ(frames_in(path), static_cast<std::size_t>(i + 1));  // immediately, not at the end
  }
  JournalReader reader(path);
  EXPECT_EQ(reader.header().data, kHeader.data);
  EXPECT_EQ(reader.header().voxel_size, kHeader.voxel_size);
  EXPECT_EQ(reader.header().min_observations, kHeader.min_observations);
  EXPECT_EQ(count_frames(reader), 5U);
  EXPECT_EQ(reader.damage(), "");
  EXPECT_EQ(read_file(path), Sample(5).bytes);
}

TEST(Journal, TruncatedFileGivesFramesBefore) {
  const TempFolder folder;
  const Sample sample(4);
  for (std::size_t size = 0; size <= sample.bytes.size(); ++size) {
    const fs::path path = folder.write("journal.bin", sample.bytes.substr(0, size));
    SCOPED_TRACE(size);
    if (size < sample.ends[0]) {
      EXPECT_THROW(JournalReader{path}, DataError);
      continue;
    }
    JournalReader reader(path);
    EXPECT_EQ(count_frames(reader), sample.complete_frames(size));
    const bool ends_at_record = sample.ends[sample.complete_frames(size)] == size;
    EXPECT_EQ(reader.damage().empty(), ends_at_record);
    if (!ends_at_record) expect_in("is truncated", reader.damage());
  }
}

TEST(Journal, DetectsChangedBytes) {
  const TempFolder folder;
  const Sample sample(3);
  for (std::size_t i = 0; i < sample.bytes.size(); ++i) {
    for (const int mask : {0x01, 0x80, 0xFF}) {
      std::string bytes = sample.bytes;
      bytes[i] = static_cast<char>(bytes[i] ^ mask);
      const fs::path path = folder.write("journal.bin", bytes);
      SCOPED_TRACE(i);
      if (i < sample.ends[0]) {
        EXPECT_THROW(JournalReader{path}, DataError);
        continue;
      }
      JournalReader reader(path);
      EXPECT_EQ(count_frames(reader), sample.complete_frames(i));
      EXPECT_NE(reader.damage(), "");
    }
  }
}

/// Reported damage of a journal with this record after one valid frame.
std::string damage_with(const TempFolder& folder, const std::string& record) {
  JournalReader reader(folder.write("journal.bin", Sample(1).bytes + record));
  EXPECT_EQ(count_frames(reader), 1U);
  return reader.damage();
}

/// The record of a frame with a changed payload and a correct checksum.
std::string changed_record(std::size_t offset, const std::string& bytes) {
  const std::string record = encode_frame(sample_frame(0));
  std::string payload = record.substr(kRecordStart, record.size() - kRecordStart - kRecordEnd);
  payload.replace(offset, bytes.size(), bytes);
  return make_record(RecordType::kFrame, payload);
}

TEST(Journal, RejectsInvalidRecordsBeforeAllocation) {
  const TempFolder folder;
  constexpr std::size_t kStatus = 16;
  constexpr std::size_t kMap = 18 + 96;  // after stamps, status, flags and pose
  constexpr std::size_t kBlocks = kMap + 12 + 8 + 1;
  const std::string many(4, '\xFF');
  expect_in("the status is 9, allowed: 0 to 4",
            damage_with(folder, changed_record(kStatus, "\x09")));
  expect_in("promises 4294967295 entries, but has space for",
            damage_with(folder, changed_record(kBlocks, many)));
  expect_in("the voxel size is 0 m",
            damage_with(folder, changed_record(kMap + 12, std::string(8, '\0'))));
  expect_in("a block is at 2147483647",
            damage_with(folder, changed_record(kBlocks + 4, "\xFF\xFF\xFF\x7F")));
  expect_in("a voxel has the index 65535",
            damage_with(folder, changed_record(kBlocks + 4 + 12 + 2 + 4, "\xFF\xFF")));
  expect_in("is truncated", damage_with(folder, many + "\x02 and not four gigabytes"));
  expect_in("has type 1, expected 2",
            damage_with(folder, make_record(RecordType::kHeader, "again")));
  expect_in("ends 8 bytes too early", damage_with(folder, make_record(RecordType::kFrame, "")));
}

TEST(Journal, RejectsOtherFiles) {
  const TempFolder folder;
  const auto open = [&](const fs::path& path) { return [path] { JournalReader reader(path); }; };
  expect_in("no such file", message_of<FileError>(open(folder.path() / "none.bin")));
  expect_in("is not a regular file", message_of<FileError>(open(folder.path())));
  expect_in("is empty", message_of<DataError>(open(folder.write("empty.bin", ""))));
  expect_in("is not a journal",
            message_of<DataError>(open(folder.write("text.bin", "hello there"))));
  std::string payload(40, '\0');
  payload[0] = 7;
  const std::string later = std::string(kJournalMagic) + make_record(RecordType::kHeader, payload);
  expect_in("has version 7, supported: version 1",
            message_of<DataError>(open(folder.write("later.bin", later))));
}

TEST(Journal, ReportsFullDisk) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
  const TempFolder folder;
  const fs::path path = folder.path() / "journal.bin";
  fs::create_symlink("/dev/full", path);
  const std::string message =
      message_of<FileError>([&] { const JournalWriter writer(path, kHeader); });
  expect_in(path.string() + ": cannot be written: No space left on device", message);
  expect_in("nowhere/journal.bin: cannot be written", message_of<FileError>([&] {
              const JournalWriter writer(folder.path() / "nowhere/journal.bin", kHeader);
            }));
}

}  // namespace
}  // namespace mms
