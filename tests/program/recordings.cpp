#include "tests/program/recordings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>

#include "mms/io/config/calibration_io.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "mms/io/text/files.hpp"

namespace mms::testing {
namespace fs = std::filesystem;
namespace {

constexpr double kDepthScale = 1000.0;
constexpr Duration kStart = std::chrono::seconds(100);

Image<std::uint16_t> raw_depth(const Image<float>& depth) {
  Image<std::uint16_t> raw(depth.width(), depth.height());
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const double units = std::isfinite(depth[i]) ? std::round(depth[i] * kDepthScale) : 0.0;
    raw[i] = static_cast<std::uint16_t>(units);
  }
  return raw;
}

/// Distance along a ray from inside a box around the origin to its sides [m].
double distance_to_sides(const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
                         const Eigen::Vector3d& half) {
  double nearest = 1e9;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(direction[axis]) < 1e-9) continue;
    const double side = direction[axis] > 0.0 ? half[axis] : -half[axis];
    nearest = std::min(nearest, (side - from[axis]) / direction[axis]);
  }
  return nearest;
}

}  // namespace

SceneConfig small_scene(int frames) {
  SceneConfig config = scene_config("corridor");
  config.frames = frames;
  config.width = 320;
  return config;
}

std::string frame_name(int index) {
  char text[16];
  std::snprintf(text, sizeof text, "%04d", index);
  return text;
}

void write_scene(const fs::path& folder, const SceneConfig& config) {
  for (const char* kind : {"rgb", "depth", "masks"}) fs::create_directories(folder / kind);
  std::ofstream color_list(folder / "rgb.txt");
  std::ofstream depth_list(folder / "depth.txt");
  SimulatedScene scene(config);
  Trajectory truth;
  for (int i = 0; i < config.frames; ++i) {
    const Frame frame = scene.render(i).frame;
    const std::string file = frame_name(i) + ".png";
    write_png(folder / "rgb" / file, frame.color);
    write_png(folder / "depth" / file, raw_depth(frame.depth));
    write_png(folder / "masks" / file, frame.mask);
    const Timestamp stamp = frame.stamp + kStart;
    color_list << stamp.to_string() << " rgb/" << file << "\n";
    depth_list << stamp.to_string() << " depth/" << file << "\n";
    truth.push_back({stamp, scene.truth(i).T_world_sensor});
    if (i > 0) continue;
    Calibration calibration = *frame.calibration;
    calibration.depth_scale = kDepthScale;
    write_calibration(folder / "calibration.yaml", calibration);
  }
  write_trajectory_tum(folder / "groundtruth.txt", truth);
}

LidarScan hall_scan(double x) {
  constexpr int kRings = 32;
  constexpr int kColumns = 720;
  const Eigen::Vector3d half(6.0, 4.0, 1.5);
  const Eigen::Vector3d from(x, 0.3, 0.2);
  LidarScan scan;
  for (int ring = 0; ring < kRings; ++ring) {
    const double elevation = (-15.0 + 30.0 * ring / (kRings - 1)) * std::numbers::pi / 180.0;
    for (int column = 0; column < kColumns; ++column) {
      const double azimuth = 2.0 * std::numbers::pi * column / kColumns;
      const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth),
                                std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      scan.points.emplace_back((ray * distance_to_sides(from, ray, half)).cast<float>());
      scan.intensity.push_back(0.5F);
    }
  }
  return scan;
}

void write_hall(const fs::path& folder, int frames) {
  constexpr double kStep = 0.05;
  fs::create_directories(folder);
  for (int i = 0; i < frames; ++i) {
    write_scan(folder / ("00" + frame_name(i) + ".bin"), hall_scan(kStep * i));
  }
}

void write_scan(const fs::path& file, const LidarScan& scan) {
  std::ofstream stream(file, std::ios::binary);
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Eigen::Vector3f& p = scan.points[i];
    const float record[4] = {p.x(), p.y(), p.z(), scan.intensity[i]};
    stream.write(reinterpret_cast<const char*>(record), sizeof record);
  }
}

nlohmann::json json_file(const fs::path& path) {
  const auto parsed = nlohmann::json::parse(read_file(path), nullptr, false);
  EXPECT_FALSE(parsed.is_discarded()) << path;
  return parsed;
}

std::set<std::string> keys_of(const nlohmann::json& object) {
  std::set<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.insert(key);
  return keys;
}

std::string segmenter_of(const std::filesystem::path& data) {
  return std::filesystem::exists(data / "masks") ? "masks" : "none";
}

}  // namespace mms::testing
