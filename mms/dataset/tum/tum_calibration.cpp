#include "mms/dataset/tum/tum_calibration.hpp"

#include <algorithm>
#include <cctype>

namespace mms {
namespace {

// https://cvg.cit.tum.de/data/datasets/rgbd-dataset/file_formats, default of ROS for depth.
constexpr double kTumDepthScale = 5000.0;
constexpr CameraIntrinsics kTumCameras[] = {
    {517.3, 516.5, 318.6, 255.3, 640, 480, {0.2624, -0.9531, -0.0054, 0.0026, 1.1633}},
    {520.9, 521.0, 325.1, 249.7, 640, 480, {0.2312, -0.7849, -0.0033, -0.0001, 0.9172}},
    {535.4, 539.2, 320.1, 247.6, 640, 480, {}}};

std::string lower_name(const std::filesystem::path& folder) {
  std::filesystem::path whole = std::filesystem::weakly_canonical(folder);
  if (!whole.has_filename()) whole = whole.parent_path();  // trailing slash
  std::string name = whole.filename().string();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

}  // namespace

std::optional<Calibration> tum_default_calibration(const std::filesystem::path& folder) {
  const std::string name = lower_name(folder);
  for (std::size_t i = 0; i < std::size(kTumCameras); ++i) {
    const std::string number = std::to_string(i + 1);
    const bool found = name.find("freiburg" + number) != std::string::npos ||
                       name.find("fr" + number) != std::string::npos;
    if (!found) continue;
    Calibration calibration;
    calibration.camera = kTumCameras[i];
    calibration.depth_scale = kTumDepthScale;
    return calibration;
  }
  return std::nullopt;
}

}  // namespace mms
