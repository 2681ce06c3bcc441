#include "mms/io/journal/journal.hpp"

#include <cmath>

#include "mms/core/error.hpp"
#include "mms/io/journal/byte_reader.hpp"
#include "mms/io/journal/journal_map.hpp"
#include "mms/io/journal/journal_record.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace {

constexpr std::uint32_t kVersion = 1;

enum Flag : std::uint8_t { kKeyframe = 1, kOrganised = 2, kMap = 4 };

using Rows = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

Transform<World, Sensor> take_pose(ByteReader& bytes) {
  Rows rows;
  for (Eigen::Index i = 0; i < rows.size(); ++i) rows.data()[i] = bytes.take<double>();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.matrix().topRows<3>() = rows;
  return Transform<World, Sensor>(pose);
}

Status take_status(ByteReader& bytes) {
  const auto status = bytes.take<std::uint8_t>();
  if (status < kStatusCount) return static_cast<Status>(status);
  throw DataError(bytes.where(), "the status is " + std::to_string(status) + ", allowed: 0 to " +
                                     std::to_string(kStatusCount - 1));
}

void expect_end(const ByteReader& bytes) {
  if (bytes.left() == 0) return;
  throw DataError(bytes.where(), "has " + std::to_string(bytes.left()) + " bytes too many");
}

}  // namespace

std::string encode_header(const JournalHeader& header) {
  std::string payload;
  append_bytes(payload, kVersion);
  append_bytes(payload, header.voxel_size);
  append_bytes(payload, static_cast<std::int32_t>(header.min_observations));
  append_bytes(payload, static_cast<std::uint32_t>(header.data.size()));
  payload += header.data;
  return std::string(kJournalMagic) + make_record(RecordType::kHeader, payload);
}

JournalHeader decode_header(std::string_view payload, const std::string& where) {
  ByteReader bytes(payload, where);
  const auto version = bytes.take<std::uint32_t>();
  if (version != kVersion) {
    throw DataError(where,
                    "has version " + std::to_string(version) + ", supported: version " +
                        std::to_string(kVersion),
                    "convert it with the version of mms that wrote it");
  }
  JournalHeader header;
  header.voxel_size = take_voxel_size(bytes);
  header.min_observations = bytes.take<std::int32_t>();
  if (header.min_observations < 1) {
    throw DataError(where, "min_observations is " + std::to_string(header.min_observations) +
                               ", allowed: at least 1");
  }
  header.data = bytes.take(bytes.take_count(1));
  expect_end(bytes);
  return header;
}

std::string encode_frame(const JournalFrame& frame) {
  std::string payload;
  append_bytes(payload, frame.stamp.nanoseconds());
  append_bytes(payload, frame.written.nanoseconds());
  append_bytes(payload, static_cast<std::uint8_t>(frame.status));
  append_bytes(payload, static_cast<std::uint8_t>((frame.keyframe ? kKeyframe : 0) |
                                                  (frame.organised ? kOrganised : 0) |
                                                  (frame.map ? kMap : 0)));
  const Rows rows = frame.T_world_sensor.isometry().matrix().topRows<3>();
  for (Eigen::Index i = 0; i < rows.size(); ++i) append_bytes(payload, rows.data()[i]);
  if (frame.map) append_map(payload, *frame.map);
  return make_record(RecordType::kFrame, payload);
}

JournalFrame decode_frame(std::string_view payload, const std::string& where) {
  ByteReader bytes(payload, where);
  JournalFrame frame;
  frame.stamp = Timestamp(bytes.take<std::int64_t>());
  frame.written = Timestamp(bytes.take<std::int64_t>());
  frame.status = take_status(bytes);
  const auto flags = bytes.take<std::uint8_t>();
  frame.keyframe = (flags & kKeyframe) != 0;
  frame.organised = (flags & kOrganised) != 0;
  frame.T_world_sensor = take_pose(bytes);
  if ((flags & kMap) != 0) frame.map = take_map(bytes);
  expect_end(bytes);
  return frame;
}

}  // namespace mms
