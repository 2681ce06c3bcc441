#include <algorithm>

#include "mms/io/video/video_reader.hpp"

namespace mms {

bool is_video_name(const std::filesystem::path& path) {
  constexpr const char* kEndings[] = {".mp4", ".MP4", ".m4v", ".mkv", ".mov", ".MOV", ".avi"};
  const std::string ending = path.extension().string();
  return std::find(std::begin(kEndings), std::end(kEndings), ending) != std::end(kEndings);
}

}  // namespace mms
