#include "mms/evaluation/tracking/object_pairing.hpp"

#include <algorithm>
#include <limits>

#include "mms/geometry/assignment.hpp"

namespace mms {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

Eigen::MatrixXd distances(const std::vector<ObjectBox>& truth, const std::vector<ObjectBox>& tracks,
                          double max_distance) {
  Eigen::MatrixXd cost(truth.size(), tracks.size());
  for (Eigen::Index i = 0; i < cost.rows(); ++i) {
    for (Eigen::Index j = 0; j < cost.cols(); ++j) {
      const double distance = (truth[static_cast<std::size_t>(i)].center() -
                               tracks[static_cast<std::size_t>(j)].center())
                                  .norm();
      cost(i, j) = distance <= max_distance ? distance : kNever;
    }
  }
  return cost;
}

int index_of(const std::vector<int>& ids, int id) {
  return static_cast<int>(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin());
}

void keep_unique(std::vector<int>& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

}  // namespace

std::vector<int> ObjectPairing::pair(const std::vector<ObjectBox>& truth,
                                     const std::vector<ObjectBox>& tracks) {
  Eigen::MatrixXd cost = distances(truth, tracks, max_distance_);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const auto known = track_of_.find(truth[i].id);
    if (known == track_of_.end()) continue;
    for (std::size_t j = 0; j < tracks.size(); ++j) {
      double& value = cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      if (tracks[j].id != known->second || value == kNever) continue;
      cost.row(static_cast<Eigen::Index>(i)).setConstant(kNever);
      cost.col(static_cast<Eigen::Index>(j)).setConstant(kNever);
      value = 0.0;
    }
  }
  std::vector<int> pairs = assign_least_cost(cost);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (pairs[i] < 0) continue;
    const int track = tracks[static_cast<std::size_t>(pairs[i])].id;
    std::erase_if(track_of_, [track](const auto& pair) { return pair.second == track; });
    track_of_[truth[i].id] = track;
  }
  return pairs;
}

std::int64_t best_identity_matches(const PairCounts& counts) {
  std::vector<int> truth_ids;
  std::vector<int> track_ids;
  std::int64_t most = 0;
  for (const auto& [ids, count] : counts) {
    truth_ids.push_back(ids.first);
    track_ids.push_back(ids.second);
    most = std::max(most, count);
  }
  keep_unique(truth_ids);
  keep_unique(track_ids);
  // Pairs that never met get the highest cost, so that they are chosen last.
  Eigen::MatrixXd cost = Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(truth_ids.size()),
                                                   static_cast<Eigen::Index>(track_ids.size()),
                                                   static_cast<double>(most));
  for (const auto& [ids, count] : counts) {
    cost(index_of(truth_ids, ids.first), index_of(track_ids, ids.second)) -=
        static_cast<double>(count);
  }
  const std::vector<int> pairs = assign_least_cost(cost);
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (pairs[i] < 0) continue;
    const auto found = counts.find({truth_ids[i], track_ids[static_cast<std::size_t>(pairs[i])]});
    if (found != counts.end()) sum += found->second;
  }
  return sum;
}

}  // namespace mms
