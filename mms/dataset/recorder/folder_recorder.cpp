#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ostream>

#include "mms/core/error.hpp"
#include "mms/dataset/recorder/frame_recorder.hpp"
#include "mms/dataset/recorder/recorded_frame.hpp"
#include "mms/dataset/recorder/recording_folder.hpp"
#include "mms/io/cloud/kitti_io.hpp"
#include "mms/io/config/calibration_io.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/io/motion/motion_io.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/text/output_folder.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

/// Common scales of depth images, units per meter.
constexpr double kDepthScales[] = {1000.0, 5000.0, 4000.0, 10000.0};

/// Whether depth images of that scale represent the depth exactly.
bool keeps(const Image<float>& depth, double scale) {
  const Image<std::uint16_t> raw = recorded_depth(depth, scale);
  const auto units = static_cast<float>(scale);
  for (std::size_t i = 0; i < raw.size(); ++i) {
    if (depth[i] > 0.0F && static_cast<float>(raw[i]) / units != depth[i]) return false;
  }
  return true;
}

/// Bags have depth in meters without the original scale. If no common scale is exact, 16 bits cover
/// 13 m in steps of 0.2 mm, or 65 m in millimeters where the first image needs that.
double depth_scale_of(const Frame& frame) {
  const double said = frame.calibration->depth_scale;
  if (keeps(frame.depth, said)) return said;
  const auto* exact = std::find_if(std::begin(kDepthScales), std::end(kDepthScales),
                                   [&](double scale) { return keeps(frame.depth, scale); });
  if (exact != std::end(kDepthScales)) return *exact;
  constexpr double kFine = 5000.0;
  constexpr double kCoarse = 1000.0;
  constexpr float kReach = 65535.0F / 5000.0F;  // [m]
  const auto& pixels = frame.depth.pixels();
  const bool is_far = std::any_of(pixels.begin(), pixels.end(), [](float d) { return d > kReach; });
  return is_far ? kCoarse : kFine;
}

template <class Sample>
void append_samples(std::vector<Sample>& all, const std::vector<Sample>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// A list that grows by a line per frame, so that it is also there after kill -9.
class GrowingList {
 public:
  explicit GrowingList(fs::path path) : path_(std::move(path)) {}

  /// @throws FileError if it cannot be written.
  void add(const std::string& line) {
    if (!buffer_.is_open() && buffer_.open(path_, std::ios::out | std::ios::binary) == nullptr) {
      fail(errno);
    }
    std::ostream stream(&buffer_);
    stream << line << '\n' << std::flush;
    if (!stream) fail(buffer_.error());
  }

 private:
  [[noreturn]] void fail(int error_number) const {
    throw FileError(path_.string(),
                    std::string("cannot be written: ") + std::strerror(error_number),
                    "check that the folder is writable and has space");
  }

  fs::path path_;
  WrittenBuffer buffer_;
};

class FolderRecorder final : public FrameRecorder {
 public:
  explicit FolderRecorder(const fs::path& folder)
      : folder_(folder),
        lock_(folder),
        color_list_(folder / "rgb.txt"),
        depth_list_(folder / "depth.txt"),
        times_(folder / "times.txt") {
    const auto names = list_folder(folder_);
    if (names.empty()) return;
    throw FileError(folder_.string(), "is not empty (it has " + names.front() + ")",
                    "choose a new folder with -o");
  }

  void add(const Frame& frame) override {
    if (count_ == 0) begin(frame);
    frame.scan.points.empty() ? add_images(frame) : add_scan(frame);
    append_samples(motion_.wheels, frame.motion.wheels);
    append_samples(motion_.imu, frame.motion.imu);
    ++count_;
  }

  void finish(const Trajectory& truth) override {
    if (!motion_.wheels.empty()) write_wheels(folder_ / "odometry.csv", motion_.wheels);
    if (!motion_.imu.empty()) write_imu(folder_ / "imu.csv", motion_.imu);
    if (lidar_ && !truth.empty()) write_poses(truth);
    if (!truth.empty()) write_trajectory_tum(folder_ / "groundtruth.txt", truth);
  }

 private:
  void begin(const Frame& frame) {
    lidar_ = !frame.scan.points.empty();
    calibration_ = *frame.calibration;
    if (frame.has_depth()) calibration_.depth_scale = depth_scale_of(frame);
    write_calibration(folder_ / "calibration.yaml", calibration_);
    if (lidar_) return;
    color_list_.add("# stamp file");
    depth_list_.add("# stamp file");
  }

  template <class Pixel>
  void write_image(const std::string& file, const Image<Pixel>& image) {
    make_folder((folder_ / file).parent_path());
    write_png(folder_ / file, image);
  }

  void add_images(const Frame& frame) {
    const std::string name = frame.stamp.to_string() + ".png";
    const Timestamp depth_stamp = frame.stamp + frame.depth_offset;
    const std::string depth_file = "depth/" + depth_stamp.to_string() + ".png";
    write_image("rgb/" + name, frame.color);
    write_image(depth_file, recorded_depth(frame.depth, calibration_.depth_scale));
    if (!frame.mask.empty()) write_image("masks/" + name, frame.mask);
    color_list_.add(frame.stamp.to_string() + " rgb/" + name);
    depth_list_.add(depth_stamp.to_string() + " " + depth_file);
  }

  void add_scan(const Frame& frame) {
    char name[32];
    std::snprintf(name, sizeof name, "%06zu", count_);
    make_folder(folder_ / "velodyne");
    write_kitti_scan(folder_ / "velodyne" / (std::string(name) + ".bin"), frame.scan);
    if (!frame.scan.time_offset.empty()) {
      make_folder(folder_ / "point_times");
      write_point_times(folder_ / "point_times" / (std::string(name) + ".bin"),
                        frame.scan.time_offset);
    }
    if (!frame.color.empty()) write_image("image_2/" + std::string(name) + ".png", frame.color);
    if (!frame.mask.empty()) write_image("masks/" + std::string(name) + ".png", frame.mask);
    times_.add(frame.stamp.to_string());
    stamps_.push_back(frame.stamp);
  }

  /// KITTI poses are those of the camera, one per scan: written only if every scan has one.
  void write_poses(const Trajectory& truth) {
    const Eigen::Isometry3d T_lidar_camera = calibration_.T_camera_lidar.isometry().inverse();
    Trajectory camera;
    for (const Timestamp stamp : stamps_) {
      for (const StampedPose& pose : truth) {
        if (pose.stamp != stamp) continue;
        camera.push_back(
            {stamp, Transform<World, Sensor>(pose.T_world_sensor.isometry() * T_lidar_camera)});
        break;
      }
    }
    if (camera.size() == stamps_.size()) write_trajectory_kitti(folder_ / "poses.txt", camera);
  }

  fs::path folder_;
  FolderLock lock_;
  Calibration calibration_;
  bool lidar_ = false;
  std::size_t count_ = 0;
  GrowingList color_list_;
  GrowingList depth_list_;
  GrowingList times_;
  std::vector<Timestamp> stamps_;
  MotionSamples motion_;
};

}  // namespace

std::unique_ptr<FrameRecorder> record_folder(const fs::path& folder) {
  return std::make_unique<FolderRecorder>(folder);
}

}  // namespace mms
