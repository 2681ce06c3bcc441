// Relocalization at random places: how often, how fast, and how often wrong.
// usage: mms_relocalize MAP_RECORDING FRAMES QUERY_RECORDING FIRST COUNT
//   Maps the first FRAMES frames, then takes COUNT times up to ten successive frames, evenly spread
//   from frame FIRST on, like a lost sensor. With two different recordings, every answer is wrong.
// Recordings need masks/ and ground truth. Prints one line, and wrong answers on stderr; exit
// status 1 if an answer is wrong.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iterator>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "mms/dataset/open_dataset.hpp"
#include "mms/geometry/se3.hpp"
#include "mms/pipeline/slam_system.hpp"
#include "mms/segmentation/segmenters/mask_segmenter.hpp"

namespace {

using mms::Frame;
using mms::Timestamp;

/// Limits beyond which an answer is wrong. Source: acceptance of relocalization.
constexpr double kMaxDistance = 0.2;                         // [m]
constexpr double kMaxTurn = 5.0 * std::numbers::pi / 180.0;  // [rad]

/// [frames]: of one case, at most. Source: 1 s at 10 Hz.
constexpr std::size_t kFrames = 10;

struct Counts {
  int cases = 0;
  int found = 0;
  int wrong = 0;
};

Eigen::Isometry3d truth_at(const mms::Trajectory& truth, Timestamp stamp) {
  const auto nearest =
      std::min_element(truth.begin(), truth.end(), [&](const auto& a, const auto& b) {
        return std::abs(mms::to_seconds(a.stamp - stamp)) <
               std::abs(mms::to_seconds(b.stamp - stamp));
      });
  return nearest->T_world_sensor.isometry();
}

/// What the sensor sees, with a pose that is not known.
mms::GlobalKeyframe perceived(mms::Perception& perception, const Frame& frame) {
  const mms::PerceivedFrame result = perception.perceive(frame, perception.segment(frame));
  return {frame.color, result.cloud, {}, true};
}

int run(const std::vector<std::string>& arguments) {
  const mms::SystemConfig config;
  mms::SlamSystem system(config, std::make_unique<mms::MaskSegmenter>());
  const auto map = mms::open_dataset(arguments[0], {});
  const mms::Trajectory map_truth = map->ground_truth();
  Timestamp first;
  for (int i = 0; i < std::stoi(arguments[1]); ++i) {
    const auto frame = map->next();
    if (!frame) break;
    if (i == 0) first = frame->stamp;
    system.process(*frame);
  }
  const bool is_known = arguments[0] == arguments[2];
  const auto query = mms::open_dataset(arguments[2], {});
  const auto begin = static_cast<std::size_t>(std::stoi(arguments[3]));
  const auto count = static_cast<std::size_t>(std::stoi(arguments[4]));
  const std::size_t step = std::max<std::size_t>(1, (query->size() - begin) / count);
  query->skip(begin);
  Counts counts;
  while (static_cast<std::size_t>(counts.cases) < count) {
    mms::Perception perception(config, std::make_unique<mms::MaskSegmenter>());
    std::optional<mms::Relocalization> place;
    std::optional<Frame> frame;
    std::size_t taken = 0;
    for (; taken < kFrames && !place && (frame = query->next()); ++taken) {
      place = system.relocalize(perceived(perception, *frame));
    }
    if (taken == 0) break;
    ++counts.cases;
    if (step > taken) query->skip(step - taken);
    if (!place) continue;
    ++counts.found;
    const Eigen::Isometry3d truth =
        truth_at(map_truth, first).inverse() * truth_at(query->ground_truth(), frame->stamp);
    const Eigen::Isometry3d error = truth.inverse() * place->T_world_sensor.isometry();
    const bool is_right =
        is_known && error.translation().norm() < kMaxDistance && mms::se3::angle(error) < kMaxTurn;
    counts.wrong += !is_right;
    if (!is_right) {
      std::fprintf(stderr, "wrong at %.3f s: %.2f m, %.1f degrees off\n",
                   mms::to_seconds(frame->stamp - Timestamp{}), error.translation().norm(),
                   mms::se3::angle(error) * 180.0 / std::numbers::pi);
    }
  }
  std::printf("%d cases, %d found, %d wrong\n", counts.cases, counts.found, counts.wrong);
  return counts.wrong == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() != 5) {
    std::fprintf(stderr, "usage: mms_relocalize MAP FRAMES QUERY FIRST COUNT\n");
    return 2;
  }
  try {
    return run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
