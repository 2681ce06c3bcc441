#include "mms/dataset/source/camera_matrix.hpp"

#include <vector>

#include "mms/core/error.hpp"
#include "mms/io/text/pose_text.hpp"
#include "mms/io/text/text_table.hpp"

namespace mms {

CameraIntrinsics camera_of_matrix(std::span<const double> numbers, int width, int height,
                                  const std::string& where) {
  if (numbers.size() != 16 && numbers.size() != 9) {
    throw DataError(where, "has " + std::to_string(numbers.size()) + " numbers",
                    "expected a 3x3 or 4x4 camera matrix");
  }
  const std::size_t side = numbers.size() == 16 ? 4 : 3;
  return {numbers[0], numbers[side + 1], numbers[2], numbers[side + 2], width, height, {}};
}

CameraIntrinsics read_camera_matrix(const std::filesystem::path& file, int width, int height) {
  const TextTable table(file);
  return camera_of_matrix(parse_finite(table.fields(), file.string()), width, height,
                          file.string());
}

}  // namespace mms
