// Time and memory of the global map as it grows: keyframes of one building on many days.
// usage: mms_map_growth COUNT RECORDING...
//   Adds the keyframes of one recording after another, each as a session, until there are COUNT.
//   RECORDING: as for mms run, with masks and ground truth, which gives the poses, with drift.
// Prints a row per 1,000 keyframes. "add": a keyframe with its search for loops, without a solution
// of the pose graph in the median.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "mms/dataset/open_dataset.hpp"
#include "mms/global_map/global_map.hpp"
#include "mms/pipeline/perception.hpp"
#include "mms/segmentation/segmenters/mask_segmenter.hpp"

namespace {

/// [-]: error of the length of a motion. Source: the odometry's in `long_aisles`.
constexpr double kScaleError = 2e-4;

/// [rad]: error of the heading per keyframe. Source: 0.3 degrees over a lap of 335 m.
constexpr double kTurnError = 6e-6;

/// [-]: keyframes of a row.
constexpr std::size_t kRow = 1000;

/// Memory of this process [MB].
double resident_mb() {
  std::ifstream file("/proc/self/statm");
  double pages = 0.0;
  file >> pages >> pages;
  return pages * 4096.0 / 1e6;
}

double percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

class Growth {
 public:
  explicit Growth(std::size_t count) : count_(count) {
    std::printf(
        "| keyframes | loops | add, median [ms] | p99 | longest | memory [kB/keyframe] |\n"
        "| --- | --- | --- | --- | --- | --- |\n");
  }

  bool is_complete() const { return added_ >= count_; }

  void add_session(const std::string& recording) {
    const auto dataset = mms::open_dataset(recording, {});
    const mms::Trajectory truth = dataset->ground_truth();
    mms::Perception perception({}, std::make_unique<mms::MaskSegmenter>());
    mms::KeyframeSelector selector(mms::SystemConfig().global_map.keyframes);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    Eigen::Isometry3d last = Eigen::Isometry3d::Identity();
    std::size_t next = 0;
    while (!is_complete()) {
      const auto frame = dataset->next();
      if (!frame) break;
      const mms::PerceivedFrame perceived = perception.perceive(*frame, perception.segment(*frame));
      while (next + 1 < truth.size() && truth[next].stamp < frame->stamp) ++next;
      const Eigen::Isometry3d now = truth[next].T_world_sensor.isometry();
      if (has_last_) {
        Eigen::Isometry3d motion = last.inverse() * now;
        motion.translation() *= 1.0 + kScaleError;
        pose = pose * motion * Eigen::AngleAxisd(kTurnError, Eigen::Vector3d::UnitY());
      }
      has_last_ = true;
      last = now;
      mms::OdometryEstimate estimate;
      estimate.stamp = frame->stamp;
      estimate.T_world_sensor = mms::Transform<mms::World, mms::Sensor>(pose);
      if (!selector.is_keyframe(estimate)) continue;
      add({frame->color, perceived.cloud, estimate.T_world_sensor, false, false, session_});
    }
    has_last_ = false;
    ++session_;
  }

 private:
  void add(const mms::GlobalKeyframe& keyframe) {
    if (added_ == 0) first_mb_ = resident_mb();
    const auto begin = std::chrono::steady_clock::now();
    global_map_.add(keyframe);
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
    times_.push_back(time.count());
    if (++added_ % kRow != 0) return;
    const auto loops = std::count_if(
        global_map_.loops().begin(), global_map_.loops().end(),
        [](const mms::Loop& loop) { return loop.outcome == mms::LoopOutcome::kAccepted; });
    std::printf("| %zu | %td | %.1f | %.1f | %.0f | %.0f |\n", added_, loops,
                percentile(times_, 0.5), percentile(times_, 0.99), percentile(times_, 1.0),
                1000.0 * (resident_mb() - first_mb_) / static_cast<double>(added_));
    std::fflush(stdout);
    times_.clear();
  }

  std::size_t count_;
  mms::GlobalMap global_map_{
      mms::SystemConfig().global_map,
      mms::with_noise(mms::SystemConfig().features, mms::SystemConfig().noise),
      mms::SystemConfig().odometry.registration};
  std::uint32_t session_ = 0;
  std::size_t added_ = 0;
  double first_mb_ = 0.0;
  std::vector<double> times_;  // of this row [ms]
  bool has_last_ = false;
};

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() < 2) {
    std::fprintf(stderr, "usage: mms_map_growth COUNT RECORDING...\n");
    return 2;
  }
  try {
    Growth growth(std::stoul(arguments[0]));
    for (std::size_t i = 1; i < arguments.size() && !growth.is_complete(); ++i) {
      growth.add_session(arguments[i]);
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
