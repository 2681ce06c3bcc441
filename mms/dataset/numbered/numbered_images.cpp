#include "mms/dataset/numbered/numbered_images.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

#include "mms/core/error.hpp"
#include "mms/dataset/source/assumed_stamp.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/text/numbers.hpp"
#include "mms/io/text/stamp_reader.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// The name without its ending; nullopt for other files.
std::optional<std::string> stem_of(const std::string& name,
                                   const std::vector<std::string>& endings) {
  for (const std::string& ending : endings) {
    if (name.ends_with(ending)) return name.substr(0, name.size() - ending.size());
  }
  return std::nullopt;
}

/// The parts of a name before and after its number.
struct NameParts {
  std::string before;
  std::string after;
};

/// Of a single image: its last number counts.
NameParts parts_of(const std::string& stem) {
  const std::size_t end = stem.find_last_of("0123456789") + 1;  // 0 without digits
  const std::size_t begin = stem.substr(0, end).find_last_not_of("0123456789") + 1;
  return {stem.substr(0, begin), stem.substr(end)};
}

/// The parts that all names have in common.
NameParts common_parts(const std::vector<std::string>& stems) {
  if (stems.size() == 1) return parts_of(stems.front());
  std::string before = stems.front();
  std::string after = stems.front();
  for (const std::string& stem : stems) {
    const auto differs = std::mismatch(before.begin(), before.end(), stem.begin(), stem.end());
    before.erase(differs.first, before.end());
    const auto ends = std::mismatch(after.rbegin(), after.rend(), stem.rbegin(), stem.rend());
    after.erase(after.begin(), ends.first.base());
  }
  while (!before.empty() && is_digit(before.back())) before.pop_back();
  after.erase(after.begin(), std::find_if_not(after.begin(), after.end(), is_digit));
  return {before, after};
}

/// Number of a file of the series; nullopt for other files.
std::optional<std::int64_t> number_of(std::string_view name, const ImageSeries& series) {
  if (!name.starts_with(series.prefix)) return std::nullopt;
  name.remove_prefix(series.prefix.size());
  for (const std::string& ending : series.endings) {
    if (!name.ends_with(ending)) continue;
    const std::string_view digits = name.substr(0, name.size() - ending.size());
    if (digits.empty() || !std::all_of(digits.begin(), digits.end(), is_digit)) continue;
    return parse_integer(digits);
  }
  return std::nullopt;
}

/// Whether the numbers of images are nanoseconds since the camera was turned on.
bool are_since_start(const std::map<std::int64_t, fs::path>& files) {
  std::vector<std::int64_t> numbers;
  for (const auto& [number, file] : files) numbers.push_back(number);
  return !numbers.empty() && numbers.front() > kMaxImageNumber &&
         are_nanoseconds_since_start(std::move(numbers), kLongestImageStep);
}

/// Stamp of an image: its number, or at the assumed rate.
Timestamp stamp_of_image(std::int64_t number, const AssumedRate& rate, const fs::path& file) {
  if (const auto stamp = stamp_of_number(number)) return *stamp;
  if (number <= kMaxImageNumber) return assumed_stamp(number, rate);
  throw DataError(file.string(), "has a number that is too large",
                  "expected at most " + std::to_string(kMaxImageNumber) +
                      ", or a stamp in milli-, micro- or nanoseconds since 1970");
}

/// As "rgb/frame_N.png", with the ending of the first file.
std::string text_of(const ImageSeries& series, const std::map<std::int64_t, fs::path>& files) {
  std::string ending = series.endings.front();
  for (const std::string& other : series.endings) {
    if (!files.empty() && files.begin()->second.string().ends_with(other)) ending = other;
  }
  return (series.folder.filename() / (series.prefix + "N" + ending)).string();
}

}  // namespace

ImageSeries find_series(const fs::path& folder, const std::vector<std::string>& endings) {
  std::vector<std::string> stems;
  for (const std::string& name : list_folder(folder)) {
    if (auto stem = stem_of(name, endings)) stems.push_back(std::move(*stem));
  }
  if (stems.empty()) return {folder, "", endings};
  const NameParts parts = common_parts(stems);
  ImageSeries series{folder, parts.before, endings};
  for (std::string& ending : series.endings) ending.insert(0, parts.after);
  return series;
}

std::map<std::int64_t, fs::path> find_numbered(const ImageSeries& series) {
  std::map<std::int64_t, fs::path> files;
  for (const std::string& name : list_folder(series.folder)) {
    if (const auto number = number_of(name, series)) files.emplace(*number, series.folder / name);
  }
  return files;
}

std::vector<std::int64_t> add_numbered_frames(RgbdRecording& recording, const ImageSeries& color,
                                              const ImageSeries& depth, const AssumedRate& rate) {
  const auto colors = find_numbered(color);
  const auto depths = find_numbered(depth);
  const bool since_start = are_since_start(colors);
  std::vector<std::int64_t> numbers;
  for (const auto& [number, file] : colors) {
    const auto other = depths.find(number);
    if (other == depths.end()) continue;
    recording.frames.push_back(
        {since_start ? Timestamp(number) : stamp_of_image(number, rate, file),
         Duration::zero(),
         file,
         other->second,
         {},
         file.stem().string()});
    numbers.push_back(number);
  }
  const std::string counts = std::to_string(colors.size()) + " color images " +
                             text_of(color, colors) + " and " + std::to_string(depths.size()) +
                             " depth images " + text_of(depth, depths);
  if (numbers.empty()) {
    throw DataError(recording.folder.string(), "has " + counts + ", and no number N with both");
  }
  recording.facts.push_back("images: " + counts + ", " + std::to_string(numbers.size()) +
                            " with both");
  if (since_start || stamp_of_number(numbers.front())) {
    recording.facts.emplace_back("stamps: names of the images");
  } else {
    recording.assumed_rate = rate;
  }
  return numbers;
}

void add_pose_lines(RgbdRecording& recording, const std::vector<std::int64_t>& numbers,
                    const fs::path& file, const PoseOfLine& pose_of) {
  const TextTable table(file);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto row = static_cast<std::size_t>(numbers[i]);
    if (row >= table.lines().size()) break;
    const TextLine& line = table.lines()[row];
    recording.ground_truth.push_back(
        {recording.frames[i].stamp, Transform<World, Sensor>(pose_of(line, table.where(line)))});
  }
  recording.facts.push_back("poses: " + file.filename().string() + ", " +
                            std::to_string(recording.ground_truth.size()));
}

}  // namespace mms
