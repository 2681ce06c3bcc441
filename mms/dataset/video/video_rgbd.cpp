#include "mms/dataset/video/video_rgbd.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "mms/core/error.hpp"
#include "mms/core/size_text.hpp"
#include "mms/dataset/source/calibration_choice.hpp"
#include "mms/dataset/source/first_image.hpp"
#include "mms/dataset/source/folder_names.hpp"
#include "mms/dataset/source/frame_association.hpp"
#include "mms/dataset/source/resized_camera.hpp"
#include "mms/dataset/source/rgbd_source.hpp"
#include "mms/io/image/picture_files.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/text/numbers.hpp"
#include "mms/io/text/pose_text.hpp"
#include "mms/io/text/stamp_reader.hpp"
#include "mms/io/text/text_table.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

constexpr const char* kDepthFolder = "depth";
constexpr const char* kCameraMatrix = "camera_matrix.csv";
constexpr const char* kOdometry = "odometry.csv";
constexpr const char* kDigits = "0123456789";
constexpr Duration kMaxStampDifference = std::chrono::milliseconds(20);  // as of TUM's lists
constexpr double kUsualShare = 0.9;  // of the images of the video that have depth
constexpr double kMaxAspectDifference = 0.01;

/// Videos of depth are made for viewing.
bool is_color_video(const std::string& name) {
  return is_video_name(name) && name.find("depth") == std::string::npos;
}

fs::path find_video(const fs::path& folder) {
  std::vector<std::string> videos;
  for (const std::string& name : list_folder(folder)) {
    if (is_color_video(name)) videos.push_back(name);
  }
  if (videos.size() == 1) return folder / videos[0];
  for (const std::string& name : videos) {
    const fs::path stem = fs::path(name).stem();
    if (stem == "rgb" || stem == "color") return folder / name;
  }
  throw DataError(
      folder.string(), "has several videos, as " + videos[0] + " and " + videos[1],
      "name the one of the color camera rgb" + fs::path(videos[0]).extension().string());
}

/// A depth image, with a number or a stamp in its name.
struct NumberedDepth {
  fs::path file;
  std::int64_t number = 0;
  std::optional<Timestamp> stamp;
};

/// nullopt for a name without number.
std::optional<NumberedDepth> parse_depth_name(const fs::path& file) {
  const std::string stem = file.stem().string();
  if (stem.find('.') != std::string::npos) {
    const auto stamp = parse_stamp(stem);
    return stamp ? std::optional(NumberedDepth{file, 0, stamp}) : std::nullopt;
  }
  const std::size_t digits = stem.find_last_not_of(kDigits) + 1;  // 0 if all are
  const auto number = parse_integer(std::string_view(stem).substr(digits));
  if (!number) return std::nullopt;
  return NumberedDepth{file, *number, stamp_of_number(*number)};
}

/// Numbers that are nanoseconds since the camera was turned on are stamps, too.
void find_stamps_since_start(std::vector<NumberedDepth>& images) {
  std::vector<std::int64_t> numbers;
  for (const NumberedDepth& image : images) numbers.push_back(image.number);
  const auto least = std::min_element(numbers.begin(), numbers.end());
  if (least == numbers.end() || *least <= kMaxImageNumber) return;
  if (!are_nanoseconds_since_start(std::move(numbers), kLongestImageStep)) return;
  for (NumberedDepth& image : images) image.stamp = Timestamp(image.number);
}

/// In the order of stamps or numbers.
std::vector<NumberedDepth> find_depth(const fs::path& folder) {
  const auto& endings = depth_endings();
  std::vector<NumberedDepth> images;
  for (const std::string& name : list_folder(folder)) {
    const fs::path file = folder / name;
    if (std::find(endings.begin(), endings.end(), file.extension()) == endings.end()) continue;
    if (auto image = parse_depth_name(file)) images.push_back(std::move(*image));
  }
  if (images.empty()) throw DataError(folder.string(), "has no depth images with numbers");
  find_stamps_since_start(images);
  std::sort(images.begin(), images.end(), [](const NumberedDepth& a, const NumberedDepth& b) {
    return std::pair(a.stamp, a.number) < std::pair(b.stamp, b.number);
  });
  return images;
}

void add_frame(RgbdRecording& recording, std::size_t index, Timestamp stamp, Duration depth_offset,
               const NumberedDepth& depth) {
  recording.frames.push_back(
      {stamp, depth_offset, {}, depth.file, {}, depth.file.stem().string(), index});
}

void match_by_stamp(RgbdRecording& recording, const std::vector<NumberedDepth>& depth) {
  const Timestamp begin = *depth.front().stamp;
  std::vector<Timestamp> color_stamps;
  for (const Duration time : recording.video->times()) color_stamps.push_back(begin + time);
  std::vector<Timestamp> depth_stamps;
  for (const NumberedDepth& image : depth) {
    if (!image.stamp) throw DataError(image.file.string(), "has no stamp in its name, others have");
    depth_stamps.push_back(*image.stamp);
  }
  for (const auto& [color, i] : associate(color_stamps, depth_stamps, kMaxStampDifference)) {
    add_frame(recording, color, color_stamps[color], depth_stamps[i] - color_stamps[color],
              depth[i]);
  }
  recording.facts.emplace_back(
      "stamps: names of the depth images; the video is taken to begin at the first one");
}

void match_by_number(RgbdRecording& recording, const std::vector<NumberedDepth>& depth) {
  const auto& times = recording.video->times();
  const auto count = static_cast<std::int64_t>(times.size());
  const std::int64_t base = depth.front().number == 1 && depth.back().number == count ? 1 : 0;
  for (const NumberedDepth& image : depth) {
    const std::int64_t index = image.number - base;
    if (index >= count) break;
    const auto at = static_cast<std::size_t>(index);
    add_frame(recording, at, Timestamp() + times[at], Duration::zero(), image);
  }
  recording.facts.emplace_back("stamps: times of the video; depth images are matched by number");
  if (static_cast<double>(depth.size()) < kUsualShare * static_cast<double>(count)) {
    recording.warnings.push_back(
        (recording.folder / kDepthFolder).string() + ": has " + std::to_string(depth.size()) +
        " depth images for " + std::to_string(count) +
        " images of the video; their numbers must be those of the video's images");
  }
}

void match_images(RgbdRecording& recording, const fs::path& video) {
  const std::vector<NumberedDepth> depth = find_depth(recording.folder / kDepthFolder);
  if (depth.front().stamp) {
    match_by_stamp(recording, depth);
  } else {
    match_by_number(recording, depth);
  }
  for (RgbdFiles& frame : recording.frames) frame.color = video;
  const std::string counts = std::to_string(recording.video->times().size()) + " images of " +
                             video.filename().string() + " and " + std::to_string(depth.size()) +
                             " depth images";
  if (recording.frames.empty()) {
    throw DataError(recording.folder.string(), "has " + counts + ", of which none belong together");
  }
  recording.facts.push_back("images: " + counts + ", " + std::to_string(recording.frames.size()) +
                            " matched");
}

/// The camera of Stray Scanner's color images; nullopt if there is no file.
std::optional<Calibration> read_camera_matrix(RgbdRecording& recording) {
  const fs::path file = recording.folder / kCameraMatrix;
  if (!fs::exists(file)) return std::nullopt;
  const TextTable table(file);
  std::vector<std::string_view> fields;
  for (const TextLine& line : table.lines()) {
    fields.insert(fields.end(), line.fields.begin(), line.fields.end());
  }
  const std::vector<double> m = parse_finite(fields, file.string());
  if (m.size() != 9) {
    throw DataError(file.string(), "has " + std::to_string(m.size()) + " numbers",
                    "expected a 3x3 camera matrix");
  }
  Calibration calibration;
  calibration.camera = CameraIntrinsics{
      m[0], m[4], m[2], m[5], recording.video->width(), recording.video->height(), {}};
  calibration.depth_scale = 1000.0;
  recording.facts.push_back(std::string("calibration: ") + kCameraMatrix);
  return calibration;
}

bool has_size(const CameraIntrinsics& camera, int width, int height) {
  return camera.width == width && camera.height == height;
}

/// Where video and depth images differ in size, the calibration may be that of either.
void fit_cameras(RgbdRecording& recording) {
  if (recording.calibration->depth_camera) return;  // the depth images are registered
  const int width = recording.video->width();
  const int height = recording.video->height();
  const Image<float> depth = first_depth(recording);
  const double aspect = static_cast<double>(width) / height;
  if (std::abs(aspect * depth.height() / depth.width() - 1.0) > kMaxAspectDifference) {
    throw DataError(recording.folder.string(),
                    "has a video of " + size_text(width, height) + " pixels and depth images of " +
                        size_text(depth.width(), depth.height()),
                    "depth images must be registered to the color images, or their camera be "
                    "stated as depth_camera in calibration.yaml");
  }
  Calibration calibration = *recording.calibration;
  CameraIntrinsics& camera = *calibration.camera;
  if (!has_size(camera, width, height) && !has_size(camera, depth.width(), depth.height())) return;
  if (has_size(camera, width, height) && has_size(camera, depth.width(), depth.height())) return;
  recording.color_camera = resized_camera(camera, width, height);
  camera = resized_camera(camera, depth.width(), depth.height());
  recording.calibration = std::make_shared<const Calibration>(calibration);
  recording.facts.emplace_back("colors: sampled for the depth images");
}

/// Poses of ARKit by number of the image: x y z and a quaternion x y z w, in newer versions after
/// stamp and number, below a line of titles.
void read_odometry(RgbdRecording& recording, const fs::path& file) {
  const TextTable table(file);
  std::map<std::size_t, Transform<World, Sensor>> poses;
  std::size_t row = 0;
  for (const TextLine& line : table.lines()) {
    if (!parse_double(line.fields[0])) continue;  // titles
    const std::string where = table.where(line);
    const bool numbered = line.fields.size() >= 9;
    const std::vector<double> n = parse_finite(line.fields, where);
    if (n.size() < 7) throw DataError(where, "has not the seven numbers of a pose");
    const double* pose = n.data() + (numbered ? 2 : 0);
    const Eigen::Quaterniond q(pose[6], pose[3], pose[4], pose[5]);
    if (!(q.norm() > 0.0)) throw DataError(where, "has a quaternion of zeros");
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() = q.normalized().toRotationMatrix();
    T.translation() = Eigen::Vector3d(pose[0], pose[1], pose[2]);
    const double number = numbered ? n[1] : static_cast<double>(row);
    if (number >= 0.0 && number < static_cast<double>(recording.video->times().size())) {
      poses.emplace(static_cast<std::size_t>(number), Transform<World, Sensor>(T));
    }
    ++row;
  }
  for (const RgbdFiles& frame : recording.frames) {
    const auto pose = poses.find(frame.video_index);
    if (pose != poses.end()) recording.ground_truth.push_back({frame.stamp, pose->second});
  }
}

void read_poses(RgbdRecording& recording) {
  const fs::path truth = recording.folder / "groundtruth.txt";
  const fs::path odometry = recording.folder / kOdometry;
  if (fs::exists(truth)) {
    recording.ground_truth = read_trajectory_tum(truth);
    recording.facts.emplace_back("poses: groundtruth.txt");
  } else if (fs::exists(odometry)) {
    read_odometry(recording, odometry);
    recording.facts.push_back("poses: odometry.csv (ARKit), " +
                              std::to_string(recording.ground_truth.size()));
  }
}

}  // namespace

bool is_video_rgbd_layout(const std::vector<std::string>& names) {
  return has_name(names, kDepthFolder) && std::any_of(names.begin(), names.end(), is_color_video);
}

std::unique_ptr<FrameSource> open_video_rgbd(const fs::path& folder, const SourceOptions& options) {
  const fs::path video = find_video(folder);
  RgbdRecording recording;
  recording.folder = folder;
  recording.video = std::make_shared<VideoReader>(video);
  const bool stray = fs::exists(folder / kCameraMatrix) && fs::exists(folder / kOdometry);
  recording.facts.emplace_back(stray ? "layout: Stray Scanner, color video and depth images"
                                     : "layout: color video and depth images");
  // Its .npy files are in millimeters whatever their type is, as in its stray_visualize.py.
  if (stray) recording.float_depth_scale = 1000.0;
  match_images(recording, video);
  choose_calibration(recording, options.camera, [&] { return read_camera_matrix(recording); });
  fit_cameras(recording);
  read_poses(recording);
  find_masks(recording, options);
  return std::make_unique<RgbdSource>(std::move(recording));
}

}  // namespace mms
