#include "mms/io/image/picture_files.hpp"

#include <algorithm>

#include "mms/io/text/files.hpp"
#include "mms/io/text/lower_case.hpp"

namespace mms {

namespace fs = std::filesystem;

const std::vector<std::string>& color_endings() {
  static const std::vector<std::string> endings = {".jpg",  ".jpeg", ".png", ".bmp",
                                                   ".webp", ".tif",  ".tiff"};
  return endings;
}

const std::vector<std::string>& depth_endings() {
  static const std::vector<std::string> endings = {".png", ".pgm", ".tif", ".tiff",
                                                   ".exr", ".pfm", ".npy"};
  return endings;
}

bool is_picture(const fs::path& path) {
  const std::string extension = lower_case(path.extension().string());
  const auto& endings = color_endings();
  return std::find(endings.begin(), endings.end(), extension) != endings.end();
}

std::vector<fs::path> list_pictures(const fs::path& folder) {
  std::vector<fs::path> pictures;
  for (const std::string& name : list_folder(folder)) {
    if (is_picture(name)) pictures.push_back(folder / name);
  }
  return pictures;
}

fs::path picture_path(const fs::path& folder, const std::string& name) {
  const fs::path below = folder / "images" / name;
  return !fs::exists(folder / name) && fs::exists(below) ? below : folder / name;
}

}  // namespace mms
