#include "mms/global_map/keyframes/scan_signature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "mms/global_map/places/best_apart.hpp"

namespace mms {
namespace {

/// [-]: rings of a signature. Source: `ScanSignature`.
constexpr std::size_t kRings = ScanSignature::kRings;

/// [-]: its sectors. Source: `ScanSignature`.
constexpr std::size_t kSectors = ScanSignature::kSectors;

/// [m]: least height over the floor. Source: as of density images.
constexpr float kMinHeight = 0.2F;

/// [m]: largest height over the floor. Source: as of density images; 250 of `kHeightUnit` in a
/// byte.
constexpr float kMaxHeight = 5.0F;

/// [m]: unit of the heights. Source: `kMaxHeight` in a byte.
constexpr float kHeightUnit = 0.02F;

/// [-]: keyframes that are compared at all headings. Source: computing time; those of nearly the
/// same shares of occupied sectors.
constexpr std::size_t kMaxCompared = 25;

/// [-]: keyframes to a better candidate up to which one shows the same place. Source: 1.5 m of
/// path; the registration converges from there.
constexpr std::size_t kGroup = 3;

/// Mean of the cosines between the columns of sectors; b is turned by some of them.
double similarity_of(const ScanSignature& a, const ScanSignature& b, std::size_t turn) {
  double sum = 0.0;
  int seen = 0;
  for (std::size_t sector = 0; sector < kSectors; ++sector) {
    const std::uint8_t* p = &a.heights[(sector + turn) % kSectors * kRings];
    const std::uint8_t* q = &b.heights[sector * kRings];
    int pq = 0;
    int pp = 0;
    int qq = 0;
    for (std::size_t ring = 0; ring < kRings; ++ring) {
      pq += p[ring] * q[ring];
      pp += p[ring] * p[ring];
      qq += q[ring] * q[ring];
    }
    if (pp == 0 && qq == 0) continue;
    ++seen;
    if (pq > 0) sum += pq / std::sqrt(static_cast<double>(pp) * static_cast<double>(qq));
  }
  return seen > 0 ? sum / seen : 0.0;
}

SimilarScan best_turn(std::size_t keyframe, const ScanSignature& known, const ScanSignature& scan) {
  SimilarScan best{keyframe, 0.0, -1.0};
  for (std::size_t turn = 0; turn < kSectors; ++turn) {
    const double similarity = similarity_of(known, scan, turn);
    if (similarity <= best.similarity) continue;
    best.turn = 2.0 * std::numbers::pi * static_cast<double>(turn) / static_cast<double>(kSectors);
    best.similarity = similarity;
  }
  return best;
}

}  // namespace

ScanSignature scan_signature(const ScanView& scan) {
  ScanSignature signature;
  if (scan.points.empty()) return signature;
  signature.heights.resize(kRings * kSectors);
  const Eigen::Isometry3f T_floor_sensor = scan.T_sensor_floor.inverse().cast<float>();
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    if (scan.is_static[i] == 0) continue;
    const Eigen::Vector3f p = T_floor_sensor * scan.points[i];
    const float distance = p.head<2>().norm();
    if (!(p.z() > kMinHeight && p.z() < kMaxHeight && distance < static_cast<float>(kRings))) {
      continue;
    }
    const float share = std::atan2(p.y(), p.x()) / (2.0F * std::numbers::pi_v<float>)+0.5F;
    const auto sector = static_cast<std::size_t>(share * kSectors) % kSectors;
    std::uint8_t& cell = signature.heights[sector * kRings + static_cast<std::size_t>(distance)];
    cell = std::max(cell, static_cast<std::uint8_t>(p.z() / kHeightUnit));
  }
  for (std::size_t i = 0; i < signature.heights.size(); ++i) {
    if (signature.heights[i] > 0) {
      signature.occupied[i % kRings] += 1.0F / static_cast<float>(kSectors);
    }
  }
  return signature;
}

std::vector<SimilarScan> ScanPlaces::find(const ScanView& scan, const IsUsable& is_usable,
                                          std::size_t max_count) const {
  const ScanSignature signature = scan_signature(scan);
  if (signature.empty()) return {};
  std::vector<std::pair<float, std::size_t>> near;
  for (std::size_t i = 0; i < signatures_.size(); ++i) {
    if (signatures_[i].empty() || !is_usable(i)) continue;
    float difference = 0.0F;
    for (std::size_t ring = 0; ring < kRings; ++ring) {
      difference += std::abs(signatures_[i].occupied[ring] - signature.occupied[ring]);
    }
    near.emplace_back(difference, i);
  }
  std::sort(near.begin(), near.end());
  near.resize(std::min(near.size(), kMaxCompared));
  std::vector<SimilarScan> all;
  for (const auto& [unused, i] : near) all.push_back(best_turn(i, signatures_[i], signature));
  std::stable_sort(all.begin(), all.end(), [](const SimilarScan& a, const SimilarScan& b) {
    return a.similarity > b.similarity;
  });
  return best_apart(all, max_count, kGroup, &SimilarScan::keyframe);
}

}  // namespace mms
