#include "mms/map_file/map_coding.hpp"
#include "mms/map_file/map_composition.hpp"
#include "mms/map_file/map_file.hpp"
#include "mms/storage/compression.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace mms::testing {
namespace {

constexpr std::size_t kLimit = std::size_t{64} << 20U;

KeyframeRecord some_keyframe(int number) {
  KeyframeRecord record;
  record.stamp = Timestamp(1000 * number);
  record.keypoints = {{BinaryDescriptor{{1, 2, 3, 4}}}, {{1.0F, 2.0F, 3.0F}}, {{0.5F, 0.5F}}};
  record.features.edges = {{{1.0F, 0.0F, 2.0F}, 0.01F}};
  record.features.planes = {{{1.0F, 0.0F, 2.0F}, {0.0F, 0.0F, -1.0F}, 0.01F}};
  record.view.camera = {80.0, 80.0, 1.5, 0.5, 4, 2, {}};
  record.view.depth_mm = Image<std::uint16_t>(4, 2, 2000);
  record.view.is_static = Image<std::uint8_t>(4, 2, 1);
  return record;
}

StampedMap some_points() {
  StampedMap surfaces;
  for (int i = 0; i < 20; ++i) {
    surfaces.cloud.points.emplace_back(0.1F * static_cast<float>(i), 1.0F, 2.0F);
    surfaces.cloud.normals.emplace_back(0.0F, 0.0F, -1.0F);
    surfaces.cloud.colors.push_back({10, 20, 30});
    surfaces.cloud.observations.push_back(2);
    surfaces.stamps.push_back(Timestamp(1000));
  }
  return surfaces;
}

std::vector<std::string> map_seeds() {
  return {bytes_of("seed.mmsmap", [](const auto& path) {
    const std::deque<KeyframeRecord> records = {some_keyframe(0), some_keyframe(1)};
    Loop loop;
    loop.query = 1;
    loop.outcome = LoopOutcome::kAccepted;
    MapFile file(path, MapFile::Mode::kCreate);
    MapSession session;
    session.voxel_size = 0.02;
    file.add_session(session, some_points(), records);
    file.set_graph(std::vector<Eigen::Isometry3d>(2, Eigen::Isometry3d::Identity()), {loop});
    file.commit();
  })};
}

void read_map_bytes(std::string_view bytes) {
  const MapFile file(as_file(bytes, "in.mmsmap"), MapFile::Mode::kRead);
  const auto ignore = [](const std::string&) {};
  file.check();
  composed_map(file, file.content(ignore), ignore);
}

// The checksum of compressed bytes hides nearly all damage from the decoders: they get bytes that
// are compressed after the damage.

std::vector<std::string> keyframe_seeds() {
  return {decompress(encode_keyframe(some_keyframe(0)), Compression::kZstd, kLimit, "seed")};
}

void read_keyframe_bytes(std::string_view bytes) {
  KeyframeRecord record;
  decode_keyframe(compress_zstd(bytes), "keyframe", record);
  static_cast<void>(record.view.cloud());
}

std::vector<std::string> submap_seeds() {
  std::vector<std::uint32_t> all(20);
  for (std::uint32_t i = 0; i < 20; ++i) all[i] = i;
  return {
      decompress(encode_surfaces(some_points(), 0.02, all), Compression::kZstd, kLimit, "seed")};
}

void read_submap_bytes(std::string_view bytes) {
  StampedMap surfaces;
  decode_surfaces(compress_zstd(bytes), "submap", surfaces);
  static_cast<void>(merged(surfaces.cloud, 0.02));
}

}  // namespace

std::vector<FuzzTarget> map_targets() {
  return {{"map_file", map_seeds, read_map_bytes},
          {"map_keyframe", keyframe_seeds, read_keyframe_bytes},
          {"map_submap", submap_seeds, read_submap_bytes}};
}

}  // namespace mms::testing
