#include "mms/global_map/loops/scan_place.hpp"

#include <algorithm>
#include <numbers>

#include "mms/geometry/se3.hpp"

namespace mms {
namespace {

/// [-]: places that are checked. Source: computing time; of 16 scans, the right place was always
/// the most similar one.
constexpr std::size_t kMaxPlaces = 5;

/// [-]: least contradiction of other places, as a multiple of that allowed. Source: a nearly
/// symmetric hall turned by half a turn has four times as much.
constexpr double kClearFactor = 2.0;

/// [m]: distance of positions that are one place. Source: errors of single scans are below 1 cm.
constexpr double kSameDistance = 0.3;

/// [rad]: the same of the angle. Source: initial choice, 5 degrees.
constexpr double kSameTurn = 5.0 * std::numbers::pi / 180.0;

/// The check of a similar scan; nothing where the scans do not fit.
std::optional<Loop> checked(const KnownScans& known, const SimilarScan& similar,
                            const KeyframeRecord& query) {
  const Eigen::Isometry3d& T_candidate_floor = known.records[similar.keyframe].scan.T_sensor_floor;
  const Eigen::Isometry3d turn(Eigen::AngleAxisd(similar.turn, Eigen::Vector3d::UnitZ()));
  // A single scan of few rings may show no floor: then the sensor is over it as the candidate's.
  for (const Eigen::Isometry3d& T_query_floor : {T_candidate_floor, query.scan.T_sensor_floor}) {
    const Loop loop =
        known.verifier.verify_nearby(known.records, known.poses, similar.keyframe, query,
                                     T_candidate_floor * turn * T_query_floor.inverse());
    if (loop.outcome == LoopOutcome::kAccepted || loop.outcome == LoopOutcome::kContradiction) {
      return loop;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<Loop> find_place_of_scan(const KnownScans& known, const LoopConfig& config,
                                       const KeyframeRecord& query) {
  std::vector<Loop> loops;
  for (const SimilarScan& similar : known.places.find(query.scan, known.is_usable, kMaxPlaces)) {
    if (const auto loop = checked(known, similar, query)) loops.push_back(*loop);
  }
  const auto best = std::min_element(loops.begin(), loops.end(), [](const Loop& a, const Loop& b) {
    return a.contradiction < b.contradiction;
  });
  if (best == loops.end() || best->outcome != LoopOutcome::kAccepted) return std::nullopt;
  const Eigen::Isometry3d pose = known.poses[best->candidate] * best->T_candidate_query;
  const bool is_clear = std::all_of(loops.begin(), loops.end(), [&](const Loop& other) {
    if (other.contradiction > kClearFactor * config.max_contradiction) return true;
    if (!known.share_frame(other.candidate, best->candidate)) return true;
    const Eigen::Isometry3d difference =
        pose.inverse() * known.poses[other.candidate] * other.T_candidate_query;
    return difference.translation().norm() < kSameDistance && se3::angle(difference) < kSameTurn;
  });
  if (!is_clear) return std::nullopt;
  return *best;
}

}  // namespace mms
