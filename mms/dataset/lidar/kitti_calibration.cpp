#include "mms/dataset/lidar/kitti_calibration.hpp"

#include <string>
#include <string_view>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/io/text/pose_text.hpp"
#include "mms/io/text/text_table.hpp"

namespace mms {
namespace {

constexpr std::size_t kMatrixNumbers = 12;

/// The 12 numbers of the line "NAME: ...".
std::vector<double> matrix_of(const TextTable& table, const std::string& file,
                              const std::string& name) {
  for (const TextLine& line : table.lines()) {
    if (line.fields[0] != name + ":") continue;
    const std::span<const std::string_view> fields(line.fields);
    std::vector<double> numbers = parse_finite(fields.subspan(1), table.where(line));
    if (numbers.size() == kMatrixNumbers) return numbers;
    throw DataError(table.where(line), "has " + std::to_string(numbers.size()) + " numbers",
                    "expected the 12 of a 3x4 matrix");
  }
  throw DataError(file, "has no line '" + name + ":'",
                  name == "Tr" ? "KITTI's archives of images have such a file; take that of "
                                 "data_odometry_calib.zip, or give another with --calibration"
                               : "it is not KITTI's; give another with --calibration");
}

}  // namespace

KittiCalibration read_kitti_calibration(const std::filesystem::path& file,
                                        const std::filesystem::path& image) {
  const TextTable table(file);
  const std::vector<double> tr = matrix_of(table, file.string(), "Tr");
  const std::vector<double> p = matrix_of(table, file.string(), "P2");
  if (!(p[0] > 0.0 && p[5] > 0.0)) throw DataError(file.string(), "P2 has no focal lengths");
  KittiCalibration result;
  result.T_camera0_lidar = isometry_from_rows(tr, file.string());
  // P2 = K [I t]: camera 2 has the axes of camera 0, and t is the position of camera 0 in it.
  const double z = p[11];
  const Eigen::Vector3d t((p[3] - p[2] * z) / p[0], (p[7] - p[6] * z) / p[5], z);
  Eigen::Isometry3d T_camera2_camera0 = Eigen::Isometry3d::Identity();
  T_camera2_camera0.translation() = t;
  result.calibration.T_camera_lidar =
      Transform<Camera, Lidar>(T_camera2_camera0 * result.T_camera0_lidar);
  if (image.empty()) return result;
  const Image<Rgb> first = read_color(image);
  result.calibration.camera =
      CameraIntrinsics{p[0], p[5], p[2], p[6], first.width(), first.height(), {}};
  return result;
}

}  // namespace mms
