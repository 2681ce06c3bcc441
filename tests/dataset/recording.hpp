#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/io/image/image_io.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms::testing {

inline constexpr int kWidth = 8;
inline constexpr int kHeight = 6;

inline const std::string kCalibration =
    "fx: 10\nfy: 10\ncx: 4\ncy: 3\nwidth: 8\nheight: 6\ndepth_scale: 1000\n";

/// Write a color or depth image of the size in kCalibration.
inline void write_color(const std::filesystem::path& path, std::uint8_t red = 50) {
  std::filesystem::create_directories(path.parent_path());
  write_png(path, Image<Rgb>(kWidth, kHeight, {red, 0, 0}));
}
inline void write_depth(const std::filesystem::path& path, std::uint16_t value = 1500) {
  std::filesystem::create_directories(path.parent_path());
  write_png(path, Image<std::uint16_t>(kWidth, kHeight, value));
}

/// "f0.png", "f1.png", ...
inline std::string file_of(int frame) {
  return std::string("f").append(std::to_string(frame)).append(".png");
}

/// Writes a TUM-layout sequence of `count` frames at 10 Hz named f0, f1, ...
inline void write_tum(const TempFolder& folder, int count) {
  std::string color;
  std::string depth;
  for (int i = 0; i < count; ++i) {
    const std::string name = file_of(i);
    write_color(folder.path() / "rgb" / name, static_cast<std::uint8_t>(i));
    write_depth(folder.path() / "depth" / name);
    color.append("5.").append(std::to_string(i)).append("00 rgb/").append(name).append("\n");
    depth.append("5.").append(std::to_string(i)).append("10 depth/").append(name).append("\n");
  }
  folder.write("rgb.txt", "# color\n" + color);
  folder.write("depth.txt", "# depth\n" + depth);
  folder.write("calibration.yaml", kCalibration);
}

/// All frames and warnings of a source.
struct Playback {
  explicit Playback(std::unique_ptr<FrameSource> opened) : source(std::move(opened)) {
    source->on_warning([this](const std::string& message) { warnings.push_back(message); });
    while (auto frame = source->next()) frames.push_back(std::move(*frame));
  }

  std::string names() const {
    std::string text;
    for (const Frame& frame : frames) text += (text.empty() ? "" : " ") + frame.name;
    return text;
  }

  std::unique_ptr<FrameSource> source;
  std::vector<std::string> warnings;
  std::vector<Frame> frames;
};

/// Whether a line contains `part`.
inline bool any_has(const std::vector<std::string>& lines, const std::string& part) {
  for (const std::string& line : lines) {
    if (line.find(part) != std::string::npos) return true;
  }
  return false;
}

}  // namespace mms::testing
