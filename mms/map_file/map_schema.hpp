#pragma once

#include <cstdint>
#include <string_view>

namespace mms {

/// The file's `application_id`: "MMSM".
inline constexpr std::int64_t kMapApplication = 0x4D4D534D;

/// The file's `user_version`; readers refuse later ones.
inline constexpr std::int64_t kMapVersion = 2;

/// Views of keyframes have no grey values in it.
inline constexpr std::int64_t kOldestMapVersion = 1;

/// Tables of a map file, see docs/map_file.md.
inline constexpr std::string_view kMapSchema = R"(
CREATE TABLE sessions (
  number INTEGER PRIMARY KEY, name TEXT, program TEXT, settings TEXT, frames INTEGER,
  begin_stamp INTEGER, end_stamp INTEGER, voxel_size REAL, points INTEGER,
  width INTEGER, height INTEGER, fx REAL, fy REAL, cx REAL, cy REAL);
CREATE TABLE keyframes (
  number INTEGER PRIMARY KEY, session INTEGER, stamp INTEGER, after_lost INTEGER,
  x REAL, y REAL, z REAL, qx REAL, qy REAL, qz REAL, qw REAL);
CREATE TABLE poses (
  keyframe INTEGER PRIMARY KEY,
  x REAL, y REAL, z REAL, qx REAL, qy REAL, qz REAL, qw REAL);
CREATE TABLE keyframe_data (keyframe INTEGER PRIMARY KEY, data BLOB);
CREATE TABLE loops (
  number INTEGER PRIMARY KEY, earlier INTEGER, later INTEGER, outcome TEXT, inliers INTEGER,
  overlap REAL, contradiction REAL,
  x REAL, y REAL, z REAL, qx REAL, qy REAL, qz REAL, qw REAL, information BLOB);
CREATE TABLE submaps (
  session INTEGER, number INTEGER, points INTEGER, data BLOB, PRIMARY KEY (session, number));
)";

}  // namespace mms
