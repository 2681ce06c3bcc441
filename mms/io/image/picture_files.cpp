#include "mms/io/image/picture_files.hpp"

#include "mms/io/text/files.hpp"

namespace mms {

namespace fs = std::filesystem;

bool is_picture(const fs::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".jpg" || extension == ".jpeg" || extension == ".png";
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
