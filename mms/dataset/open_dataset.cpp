#include "mms/dataset/open_dataset.hpp"

#include <algorithm>

#include "mms/core/error.hpp"
#include "mms/dataset/bag/bag_source.hpp"
#include "mms/dataset/camera/camera_device.hpp"
#include "mms/dataset/camera/oni_source.hpp"
#include "mms/dataset/capture/capture_source.hpp"
#include "mms/dataset/folder/folder_rgbd.hpp"
#include "mms/dataset/lidar/lidar_scans.hpp"
#include "mms/dataset/numbered/arkit_scenes.hpp"
#include "mms/dataset/numbered/open3d.hpp"
#include "mms/dataset/numbered/replica.hpp"
#include "mms/dataset/numbered/scannet.hpp"
#include "mms/dataset/numbered/scannetpp.hpp"
#include "mms/dataset/numbered/tartan_air.hpp"
#include "mms/dataset/simulated/simulated_source.hpp"
#include "mms/dataset/source/folder_names.hpp"
#include "mms/dataset/tum/euroc.hpp"
#include "mms/dataset/tum/tum_rgbd.hpp"
#include "mms/dataset/video/video_rgbd.hpp"
#include "mms/io/capture/packet_capture.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/video/video_reader.hpp"
#include "mms/ros/bag/bag_files.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

using Names = std::vector<std::string>;

struct FolderLayout {
  bool (*matches)(const Names& names);
  std::unique_ptr<FrameSource> (*open)(const fs::path& folder, const SourceOptions& options);
};

/// The first one that matches is used.
constexpr FolderLayout kLayouts[] = {{is_scannetpp_layout, open_scannetpp},
                                     {is_arkit_scenes_layout, open_arkit_scenes},
                                     {is_euroc_layout, open_euroc},
                                     {is_scannet_layout, open_scannet},
                                     {is_open3d_layout, open_open3d},
                                     {is_tum_rgbd_layout, open_tum_rgbd},
                                     {is_replica_layout, open_replica},
                                     {is_tartan_air_layout, open_tartan_air},
                                     {is_folder_rgbd_layout, open_folder_rgbd},
                                     {is_video_rgbd_layout, open_video_rgbd},
                                     {is_lidar_scans_layout, open_lidar_scans},
                                     {is_bag_folder, open_bag}};

const FolderLayout* layout_of(const Names& names) {
  const auto* found =
      std::find_if(std::begin(kLayouts), std::end(kLayouts),
                   [&](const FolderLayout& layout) { return layout.matches(names); });
  return found == std::end(kLayouts) ? nullptr : found;
}

/// "has a, b, c and 5 more", for messages.
std::string found_text(const Names& names) {
  constexpr std::size_t kShown = 4;
  if (names.empty()) return "is empty";
  std::string text = "has ";
  for (std::size_t i = 0; i < std::min(kShown, names.size()); ++i) {
    text += (i == 0 ? "" : ", ") + names[i];
  }
  if (names.size() > kShown) text += " and " + std::to_string(names.size() - kShown) + " more";
  return text;
}

/// Bags and captures in a folder are separate recordings.
std::string find_bag(const fs::path& folder, const Names& names) {
  for (const std::string& name : names) {
    if (is_bag_name(name) || is_capture_name(name) || is_oni_name(name))
      return (folder / name).string();
  }
  return "";
}

/// A recording in a subfolder, as in unpacked archives; empty for none.
std::string find_recording(const fs::path& folder, const Names& names) {
  for (const std::string& name : names) {
    std::error_code error;
    const fs::path nested = folder / name;
    if (!fs::is_directory(nested, error)) continue;
    if (layout_of(list_folder(nested)) != nullptr) return nested.string();
  }
  return "";
}

/// Files of recordings that are not read, and what to do with them.
struct OtherFile {
  const char* ending;
  const char* what;
  const char* hint;
};
constexpr OtherFile kOtherFiles[] = {
    {".sens", "is a scan of ScanNet",
     "export color, depth, poses and intrinsics with its SensReader"},
    {".mkv", "is a video or a recording of Azure Kinect",
     "export color/, depth/ and intrinsic.json with Open3D's azure_kinect_mkv_reader"},
    {".svo", "is a recording of a ZED camera", "export color and depth images with its SDK"},
    {".svo2", "is a recording of a ZED camera", "export color and depth images with its SDK"},
    {".klg", "is a recording of Kintinuous", "export color and depth images"},
    {".zip", "is an archive", "unpack it"},
    {".tgz", "is an archive", "unpack it"},
    {".gz", "is an archive", "unpack it"},
    {".tar", "is an archive", "unpack it"},
    {".7z", "is an archive", "unpack it"}};

constexpr const char* kVideoHint =
    "depth images are needed, too: give a folder with the video and depth/";

[[noreturn]] void fail_file(const fs::path& file) {
  const std::string name = file.filename().string();
  if (is_video_name(file) && !name.ends_with(".mkv")) {
    throw DataError(file.string(), "is a video", kVideoHint);
  }
  for (const OtherFile& other : kOtherFiles) {
    if (name.ends_with(other.ending)) throw DataError(file.string(), other.what, other.hint);
  }
  throw DataError(file.string(),
                  "is a file; a recording is a folder, a ROS bag (.bag, .mcap, .db3), a capture of "
                  "LiDAR packets (.pcap) or a recording of OpenNI (.oni)");
}

[[noreturn]] void fail_unknown(const fs::path& folder, const Names& names) {
  for (const std::string& name : names) {
    if (is_video_name(name)) {
      throw DataError(folder.string(), found_text(names) + ", and no depth images", kVideoHint);
    }
  }
  if (has_name(names, "sequences")) {
    throw DataError(folder.string(), "has several sequences", "choose one, as --sequence 00");
  }
  std::string nested = find_recording(folder, names);
  if (nested.empty()) nested = find_bag(folder, names);
  throw DataError(folder.string(), found_text(names) + ": no recording found",
                  !nested.empty() ? "did you mean " + nested + "?"
                                  : "expected rgb.txt and depth.txt or associations.txt (TUM "
                                    "RGB-D), numbered images in color/ and depth/ (Open3D, "
                                    "ScanNet), results/ (Replica), *.color.png and *.depth.png "
                                    "(7-Scenes), or scans of a LiDAR; docs/formats.md has all");
}

void reject_topics(const fs::path& path, const SourceOptions& options) {
  if (options.topics.empty()) return;
  throw DataError(path.string(), "is not a bag and has no topics", "omit --topic-*");
}

/// A recording without its wheels and gyroscope.
std::unique_ptr<FrameSource> open_frames(const fs::path& path, const SourceOptions& options) {
  if (is_simulated(path.string())) {
    if (!options.camera.empty()) {
      throw DataError(path.string(), "is a simulation and has its own camera",
                      "omit --calibration, --intrinsics and --depth-scale");
    }
    reject_topics(path, options);
    return open_simulated(path.string(), options);
  }
  if (is_camera_address(path.string())) {
    throw DataError(path.string(), "is a camera, not a recording",
                    "mms run " + path.string() + " --record DIR keeps what comes in");
  }
  std::error_code error;
  if (!fs::exists(path, error)) throw DataError(path.string(), "no such recording");
  const bool folder = fs::is_directory(path, error);
  if (!folder && is_bag_name(path)) return open_bag(path, options);
  if (!folder && is_capture_name(path)) return open_capture(path, options);
  if (!folder && is_oni_name(path)) {
    reject_topics(path, options);
    return open_oni_recording(path, options);
  }
  if (!folder) fail_file(path);
  const Names names = list_folder(path);
  const FolderLayout* layout = layout_of(names);
  if (layout == nullptr) fail_unknown(path, names);
  if (layout->open != open_bag) reject_topics(path, options);
  return layout->open(path, options);
}

void set_rate(FrameSource& source, const fs::path& path, double rate) {
  if (source.set_rate(rate)) return;
  throw DataError(path.string(), "has time stamps of its own",
                  "omit --rate, which is for recordings without them");
}

bool is_given(const fs::path& file) {
  return !file.empty() && file != "none";
}

}  // namespace

std::unique_ptr<FrameSource> open_dataset(const fs::path& path, const SourceOptions& options) {
  std::unique_ptr<FrameSource> source = open_frames(path, options);
  if (options.rate) set_rate(*source, path, *options.rate);
  if (is_simulated(path.string())) {
    if (!is_given(options.motion.wheels) && !is_given(options.motion.imu)) return source;
    throw DataError(path.string(), "is a simulation and has its own wheels and gyroscope",
                    "as in sim:crowd?wheels.enabled=true; omit --wheels and --imu");
  }
  MotionRecording motion = read_motion_files(path, options.motion);
  if (!motion.samples.empty() || !motion.warnings.empty()) source->add_motion(std::move(motion));
  return source;
}

}  // namespace mms
