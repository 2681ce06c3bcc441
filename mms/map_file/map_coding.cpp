#include "mms/map_file/map_coding.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/geometry/se3.hpp"
#include "mms/io/journal/byte_reader.hpp"
#include "mms/storage/compression.hpp"

namespace mms {
namespace {

/// [B]: largest decompressed value.
constexpr std::size_t kMaxDecoded = std::size_t{256} << 20U;

/// [B], [-]: plausible size of a decompressed value, for a small one and by its compressed size.
constexpr std::size_t kMaxSmall = std::size_t{1} << 18U;
constexpr std::size_t kMaxRatio = 200;

/// [px]: largest side of the view of a keyframe.
constexpr int kMaxViewSide = 1024;

std::string decompressed(std::string_view compressed, const std::string& where) {
  const std::size_t limit = std::min(kMaxDecoded, kMaxSmall + kMaxRatio * compressed.size());
  return decompress(compressed, Compression::kZstd, limit, where);
}

/// Appends the first bytes of all items, then the second ones, and so on: similar numbers differ in
/// their last bytes alone, so that the others are compressed.
template <class T>
void append_planes(std::string& bytes, const std::vector<T>& items) {
  append_bytes(bytes, static_cast<std::uint32_t>(items.size()));
  const auto* raw = reinterpret_cast<const char*>(items.data());
  for (std::size_t byte = 0; byte < sizeof(T); ++byte) {
    for (std::size_t i = 0; i < items.size(); ++i) bytes.push_back(raw[i * sizeof(T) + byte]);
  }
}

template <class T>
std::vector<T> take_planes(ByteReader& reader) {
  std::vector<T> items(reader.take_count(sizeof(T)));
  auto* raw = reinterpret_cast<char*>(items.data());
  for (std::size_t byte = 0; byte < sizeof(T); ++byte) {
    const std::string_view plane = reader.take(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) raw[i * sizeof(T) + byte] = plane[i];
  }
  return items;
}

void check_equal(std::size_t size, std::size_t expected, const ByteReader& reader) {
  if (size == expected) return;
  throw DataError(reader.where(), "is damaged: " + std::to_string(size) + " values for " +
                                      std::to_string(expected) + " points");
}

/// Points that are no numbers would end in no voxel.
template <class Items, class Point>
void check_finite(const Items& items, const Point& point, const ByteReader& reader) {
  for (const auto& item : items) {
    if (!point(item).allFinite())
      throw DataError(reader.where(), "is damaged: a point is not finite");
  }
}

void check_end(const ByteReader& reader) {
  if (reader.left() == 0) return;
  throw DataError(reader.where(),
                  "is damaged: " + std::to_string(reader.left()) + " bytes too many");
}

void append(std::string& bytes, const CameraIntrinsics& camera) {
  append_bytes(bytes, static_cast<std::int32_t>(camera.width));
  append_bytes(bytes, static_cast<std::int32_t>(camera.height));
  for (const double value : {camera.fx, camera.fy, camera.cx, camera.cy}) {
    append_bytes(bytes, value);
  }
  for (const double value : camera.distortion) append_bytes(bytes, value);
}

CameraIntrinsics take_camera(ByteReader& reader) {
  CameraIntrinsics camera;
  camera.width = reader.take<std::int32_t>();
  camera.height = reader.take<std::int32_t>();
  for (double* value : {&camera.fx, &camera.fy, &camera.cx, &camera.cy}) {
    *value = reader.take<double>();
  }
  for (double& value : camera.distortion) value = reader.take<double>();
  const auto is_side = [](int side) { return side >= 0 && side <= kMaxViewSide; };
  const bool is_camera =
      std::isfinite(camera.cx) && std::isfinite(camera.cy) && camera.fx > 0.0 && camera.fy > 0.0;
  if (is_side(camera.width) && is_side(camera.height) &&
      (is_camera || camera.width * camera.height == 0)) {
    return camera;
  }
  throw DataError(reader.where(), "is damaged: its view has no valid camera");
}

template <class T>
void append(std::string& bytes, const Image<T>& image) {
  append_planes(bytes, image.pixels());
}

template <class T>
Image<T> take_image(ByteReader& reader, const CameraIntrinsics& camera) {
  Image<T> image(camera.width, camera.height);
  std::vector<T> pixels = take_planes<T>(reader);
  check_equal(pixels.size(), image.size(), reader);
  image.pixels() = std::move(pixels);
  return image;
}

void append(std::string& bytes, const ScanView& scan) {
  append_planes(bytes, scan.points);
  append_planes(bytes, scan.is_static);
  const Eigen::Matrix<double, 3, 4> T = scan.T_sensor_floor.affine();
  for (Eigen::Index i = 0; i < T.size(); ++i) append_bytes(bytes, T(i));
}

ScanView take_scan(ByteReader& reader) {
  ScanView scan;
  scan.points = take_planes<Eigen::Vector3f>(reader);
  scan.is_static = take_planes<std::uint8_t>(reader);
  check_equal(scan.is_static.size(), scan.points.size(), reader);
  Eigen::Matrix<double, 3, 4> T;
  for (Eigen::Index i = 0; i < T.size(); ++i) T(i) = reader.take<double>();
  if (!T.allFinite()) throw DataError(reader.where(), "is damaged: its floor is none");
  scan.T_sensor_floor.affine() = T;
  scan.T_sensor_floor = se3::normalized(scan.T_sensor_floor);
  return scan;
}

/// [-]: steps of a point's coordinates along the side of a voxel.
constexpr double kQuantaPerVoxel = 32.0;

/// [-]: bits of a coordinate: 1.3 km at voxels of 2 cm.
constexpr unsigned kCoordinateBits = 21;

/// [m]: largest coordinate of a map.
constexpr float kMaxPosition = 1e6F;

/// [ns]: unit of the stamps of surfaces; corrections change little in it.
constexpr Duration kStampUnit = std::chrono::milliseconds(10);

/// [s]: largest first stamp, so that later ones fit into 64 bits of nanoseconds.
constexpr double kMaxStamp = 9e9;

/// Coordinates in steps from the corner of a submap, interleaved bit by bit, so that neighbors have
/// similar keys (Morton, 1966).
struct SurfaceGrid {
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();  // [m]
  float quantum = 1.0F;                              // [m]

  std::uint64_t key_of(const Eigen::Vector3f& point) const {
    constexpr float kMax = (1U << kCoordinateBits) - 1U;
    const Eigen::Array3f steps = ((point - origin) / quantum).array().round().min(kMax);
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto coordinate = static_cast<std::uint64_t>(steps[axis]);
      for (unsigned bit = 0; bit < kCoordinateBits; ++bit) {
        key |= (coordinate >> bit & 1U) << (3U * bit + static_cast<unsigned>(axis));
      }
    }
    return key;
  }

  Eigen::Vector3f point_of(std::uint64_t key) const {
    Eigen::Vector3f point = origin;
    for (int axis = 0; axis < 3; ++axis) {
      std::uint64_t coordinate = 0;
      for (unsigned bit = 0; bit < kCoordinateBits; ++bit) {
        coordinate |= (key >> (3U * bit + static_cast<unsigned>(axis)) & 1U) << bit;
      }
      point[axis] += static_cast<float>(coordinate) * quantum;
    }
    return point;
  }
};

/// [-]: the code of an unknown normal.
constexpr std::array<std::int8_t, 2> kNoNormal = {-128, -128};

/// A unit vector on the faces of an octahedron, unfolded to a square of 255 x 255 steps
/// (Meyer et al., EGSR 2010).
std::array<std::int8_t, 2> octahedral(const Eigen::Vector3f& normal) {
  const float sum = normal.cwiseAbs().sum();
  if (!(sum > 0.0F)) return kNoNormal;
  const Eigen::Vector3f n = normal / sum;
  Eigen::Vector2f square = n.head<2>();
  if (n.z() < 0.0F) {
    const Eigen::Vector2f folded(1.0F - std::abs(n.y()), 1.0F - std::abs(n.x()));
    square = {std::copysign(folded.x(), n.x()), std::copysign(folded.y(), n.y())};
  }
  const auto step = [](float value) {
    return static_cast<std::int8_t>(std::lround(127.0F * value));
  };
  return {step(square.x()), step(square.y())};
}

Eigen::Vector3f from_octahedral(const std::array<std::int8_t, 2>& code) {
  if (code == kNoNormal) return Eigen::Vector3f::Zero();
  const float x = static_cast<float>(code[0]) / 127.0F;
  const float y = static_cast<float>(code[1]) / 127.0F;
  Eigen::Vector3f n(x, y, 1.0F - std::abs(x) - std::abs(y));
  if (n.z() < 0.0F) {
    n.x() = std::copysign(1.0F - std::abs(y), x);
    n.y() = std::copysign(1.0F - std::abs(x), y);
  }
  return n.normalized();
}

}  // namespace

std::string encode_keyframe(const KeyframeRecord& keyframe) {
  std::string bytes;
  append_planes(bytes, keyframe.keypoints.descriptors);
  append_planes(bytes, keyframe.keypoints.points);
  append_planes(bytes, keyframe.keypoints.pixels);
  append_bytes(bytes, keyframe.features.stamp.nanoseconds());
  append_planes(bytes, keyframe.features.edges);
  append_planes(bytes, keyframe.features.planes);
  append(bytes, keyframe.view.camera);
  append(bytes, keyframe.view.depth_mm);
  append(bytes, keyframe.view.is_static);
  if (!keyframe.view.gray.empty()) append(bytes, keyframe.view.gray);
  if (keyframe.is_scan()) append(bytes, keyframe.scan);
  return compress_zstd(bytes);
}

void decode_keyframe(std::string_view compressed, const std::string& where,
                     KeyframeRecord& keyframe) {
  const std::string bytes = decompressed(compressed, where);
  ByteReader reader(bytes, where);
  ImageKeypoints& keypoints = keyframe.keypoints;
  keypoints.descriptors = take_planes<BinaryDescriptor>(reader);
  keypoints.points = take_planes<Eigen::Vector3f>(reader);
  keypoints.pixels = take_planes<Eigen::Vector2f>(reader);
  check_equal(keypoints.descriptors.size(), keypoints.points.size(), reader);
  check_equal(keypoints.pixels.size(), keypoints.points.size(), reader);
  keyframe.features.stamp = Timestamp(reader.take<std::int64_t>());
  keyframe.features.edges = take_planes<EdgeFeature>(reader);
  keyframe.features.planes = take_planes<PlaneFeature>(reader);
  keyframe.view.camera = take_camera(reader);
  keyframe.view.depth_mm = take_image<std::uint16_t>(reader, keyframe.view.camera);
  keyframe.view.is_static = take_image<std::uint8_t>(reader, keyframe.view.camera);
  const bool has_view = !keyframe.view.depth_mm.empty();
  if (has_view && reader.left() > 0)
    keyframe.view.gray = take_image<std::uint8_t>(reader, keyframe.view.camera);
  if (!has_view && reader.left() > 0) keyframe.scan = take_scan(reader);
  check_end(reader);
  const auto position = [](const auto& feature) { return feature.point; };
  for (const auto* points : {&keypoints.points, &keyframe.scan.points}) {
    check_finite(
        *points, [](const Eigen::Vector3f& point) { return point; }, reader);
  }
  check_finite(keyframe.features.edges, position, reader);
  check_finite(keyframe.features.planes, position, reader);
}

std::string encode_surfaces(const StampedMap& surfaces, double voxel_size,
                            std::vector<std::uint32_t> indices) {
  const MapCloud& cloud = surfaces.cloud;
  SurfaceGrid grid;
  grid.quantum = static_cast<float>(voxel_size / kQuantaPerVoxel);
  Timestamp begin(std::numeric_limits<std::int64_t>::max());
  if (!indices.empty()) {
    grid.origin.setConstant(std::numeric_limits<float>::max());
  }
  for (const std::uint32_t i : indices) {
    grid.origin = grid.origin.cwiseMin(cloud.points[i]);
    begin = std::min(begin, surfaces.stamps[i]);
  }
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;  // by place
  for (const std::uint32_t i : indices) order.emplace_back(grid.key_of(cloud.points[i]), i);
  std::sort(order.begin(), order.end());
  std::vector<std::uint64_t> steps;
  std::vector<std::array<std::int8_t, 2>> normals;
  std::vector<std::array<std::uint8_t, 3>> colors;
  std::vector<std::uint16_t> views;
  std::vector<std::uint32_t> stamps;
  std::uint64_t key = 0;
  Rgb color{};
  for (const auto& [place, i] : order) {
    steps.push_back(place - std::exchange(key, place));
    normals.push_back(octahedral(cloud.normals[i]));
    const Rgb before = std::exchange(color, cloud.colors[i]);
    colors.push_back({static_cast<std::uint8_t>(color.r - before.r),
                      static_cast<std::uint8_t>(color.g - before.g),
                      static_cast<std::uint8_t>(color.b - before.b)});
    views.push_back(static_cast<std::uint16_t>(std::min(cloud.observations[i], 65535)));
    stamps.push_back(static_cast<std::uint32_t>((surfaces.stamps[i] - begin) / kStampUnit));
  }
  std::string bytes;
  for (int axis = 0; axis < 3; ++axis) append_bytes(bytes, grid.origin[axis]);
  append_bytes(bytes, grid.quantum);
  append_bytes(bytes, begin.nanoseconds());
  append_planes(bytes, steps);
  append_planes(bytes, normals);
  append_planes(bytes, colors);
  append_planes(bytes, views);
  append_planes(bytes, stamps);
  return compress_zstd(bytes);
}

void decode_surfaces(std::string_view compressed, const std::string& where, StampedMap& surfaces) {
  const std::string bytes = decompressed(compressed, where);
  ByteReader reader(bytes, where);
  SurfaceGrid grid;
  for (int axis = 0; axis < 3; ++axis) grid.origin[axis] = reader.take<float>();
  grid.quantum = reader.take<float>();
  const Timestamp begin(reader.take<std::int64_t>());
  const auto steps = take_planes<std::uint64_t>(reader);
  const auto normals = take_planes<std::array<std::int8_t, 2>>(reader);
  const auto colors = take_planes<std::array<std::uint8_t, 3>>(reader);
  const auto views = take_planes<std::uint16_t>(reader);
  const auto stamps = take_planes<std::uint32_t>(reader);
  check_end(reader);
  for (const std::size_t size : {normals.size(), colors.size(), views.size(), stamps.size()}) {
    check_equal(size, steps.size(), reader);
  }
  if (!(grid.origin.cwiseAbs().maxCoeff() < kMaxPosition) ||
      !(grid.quantum > 0.0F && grid.quantum < 10.0F)) {
    throw DataError(where, "is damaged: its grid is none");
  }
  if (!steps.empty() && std::abs(begin.seconds()) > kMaxStamp) {
    throw DataError(where, "is damaged: its stamps are out of range");
  }
  if (std::find(views.begin(), views.end(), 0) != views.end()) {
    throw DataError(where, "is damaged: a point has no observation");
  }
  std::uint64_t key = 0;
  Rgb color{};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    key += steps[i];
    color.r = static_cast<std::uint8_t>(color.r + colors[i][0]);
    color.g = static_cast<std::uint8_t>(color.g + colors[i][1]);
    color.b = static_cast<std::uint8_t>(color.b + colors[i][2]);
    surfaces.cloud.points.push_back(grid.point_of(key));
    surfaces.cloud.normals.push_back(from_octahedral(normals[i]));
    surfaces.cloud.colors.push_back(color);
    surfaces.cloud.observations.push_back(views[i]);
    surfaces.stamps.push_back(begin + stamps[i] * kStampUnit);
  }
}

}  // namespace mms
