#include "mms/dataset/tum/tum_calibration.hpp"

#include <string>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/io/text/lower_case.hpp"
#include "mms/io/text/pose_text.hpp"
#include "mms/io/text/text_table.hpp"

namespace mms {
namespace {

// All data sets of this layout have 5000 units per meter.
constexpr double kTumDepthScale = 5000.0;

struct NamedCamera {
  const char* name = "";  ///< part of the folder's name
  CameraIntrinsics camera;
};

constexpr CameraIntrinsics kFreiburg1 = {
    517.3, 516.5, 318.6, 255.3, 640, 480, {0.2624, -0.9531, -0.0054, 0.0026, 1.1633}};
constexpr CameraIntrinsics kFreiburg2 = {
    520.9, 521.0, 325.1, 249.7, 640, 480, {0.2312, -0.7849, -0.0033, -0.0001, 0.9172}};
constexpr CameraIntrinsics kFreiburg3 = {535.4, 539.2, 320.1, 247.6, 640, 480, {}};
constexpr CameraIntrinsics kBonn = {542.822841,
                                    542.576870,
                                    315.593520,
                                    237.756098,
                                    640,
                                    480,
                                    {0.039903, -0.099343, -0.000730, -0.000144, 0.0}};

// https://cvg.cit.tum.de/data/datasets/rgbd-dataset/file_formats and
// https://www.ipb.uni-bonn.de/data/rgbd-dynamic-dataset
constexpr NamedCamera kCameras[] = {
    {"freiburg1", kFreiburg1}, {"fr1", kFreiburg1}, {"freiburg2", kFreiburg2}, {"fr2", kFreiburg2},
    {"freiburg3", kFreiburg3}, {"fr3", kFreiburg3}, {"rgbd_bonn", kBonn}};

Calibration calibration_of(const CameraIntrinsics& camera) {
  Calibration calibration;
  calibration.camera = camera;
  calibration.depth_scale = kTumDepthScale;
  return calibration;
}

std::string lower_name(const std::filesystem::path& folder) {
  std::filesystem::path whole = std::filesystem::weakly_canonical(folder);
  if (!whole.has_filename()) whole = whole.parent_path();  // trailing slash
  return lower_case(whole.filename().string());
}

}  // namespace

std::optional<Calibration> default_calibration(const std::filesystem::path& folder) {
  const std::string name = lower_name(folder);
  for (const NamedCamera& known : kCameras) {
    if (name.find(known.name) != std::string::npos) return calibration_of(known.camera);
  }
  return std::nullopt;
}

// https://www.doc.ic.ac.uk/~ahanda/VaFRIC/codes.html has fy = -480 for a y axis that is up.
Calibration icl_nuim_calibration() {
  return calibration_of({481.2, 480.0, 319.5, 239.5, 640, 480, {}});
}

Calibration read_eth3d_calibration(const std::filesystem::path& file, const Image<Rgb>& image) {
  const TextTable table(file);
  const std::vector<double> k = parse_finite(table.fields(), file.string());
  if (k.size() != 4 || k[0] <= 0.0 || k[1] <= 0.0) {
    throw DataError(file.string(), "has " + std::to_string(k.size()) + " numbers",
                    "expected fx fy cx cy in pixels, focal lengths above 0");
  }
  return calibration_of({k[0], k[1], k[2], k[3], image.width(), image.height(), {}});
}

}  // namespace mms
