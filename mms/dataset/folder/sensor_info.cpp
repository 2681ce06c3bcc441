#include "mms/dataset/folder/sensor_info.hpp"

#include <Eigen/Core>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/dataset/source/camera_matrix.hpp"
#include "mms/io/text/pose_text.hpp"
#include "mms/io/text/text_table.hpp"

namespace mms {
namespace {

/// [px]: largest size of an image. Source: no camera has more pixels in a row.
constexpr double kMaxSize = 65535.0;

/// The entries "name = values" of a file.
class Entries {
 public:
  explicit Entries(const std::filesystem::path& file) : file_(file.string()), table_(file) {
    for (const TextLine& line : table_.lines()) {
      if (line.fields.size() < 3 || line.fields[1] != "=") continue;
      lines_.emplace(std::string(line.fields[0]), &line);
    }
  }

  /// Empty if there is no such entry.
  std::vector<double> find(const std::string& name) const {
    const auto found = lines_.find(name);
    if (found == lines_.end()) return {};
    const std::vector<std::string_view>& fields = found->second->fields;
    return parse_finite({fields.begin() + 2, fields.end()}, where(name));
  }

  double positive(const std::string& name) const {
    const std::vector<double> values = find(name);
    if (values.size() == 1 && values.front() > 0.0) return values.front();
    throw DataError(file_, name + " is missing or no positive number");
  }

  int size(const std::string& name) const {
    const double value = positive(name);
    if (value > kMaxSize) throw DataError(file_, name + " is more than 65535 pixels");
    return static_cast<int>(value);
  }

  /// @param prefix  of the names of its size
  /// @param matrix  name of its camera matrix
  CameraIntrinsics camera(const std::string& prefix, const std::string& matrix) const {
    const int width = size(prefix + "Width");
    const int height = size(prefix + "Height");
    return camera_of_matrix(find(matrix), width, height, where(matrix));
  }

  bool has_extrinsic(const std::string& kind) const {
    const std::vector<double> m = find("m_calibration" + kind + "Extrinsic");
    return m.size() == 16 && !Eigen::Map<const Eigen::Matrix4d>(m.data()).isIdentity();
  }

 private:
  std::string where(const std::string& name) const { return file_ + ": " + name; }

  std::string file_;
  TextTable table_;
  std::map<std::string, const TextLine*> lines_;
};

}  // namespace

SensorInfo read_sensor_info(const std::filesystem::path& file) {
  const Entries entries(file);
  SensorInfo info;
  info.color = entries.camera("m_color", "m_calibrationColorIntrinsic");
  info.depth = entries.camera("m_depth", "m_calibrationDepthIntrinsic");
  info.depth_scale = entries.positive("m_depthShift");
  info.has_extrinsics = entries.has_extrinsic("Color") || entries.has_extrinsic("Depth");
  return info;
}

}  // namespace mms
