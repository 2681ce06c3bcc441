#include "mms/fusion/clusters/label_propagation.hpp"

#include <array>
#include <cstddef>
#include <limits>

namespace mms {
namespace {

struct Candidate {
  int seed = -1;
  float distance2 = std::numeric_limits<float>::infinity();  ///< squared [m^2]
};

struct Offset {
  int x;
  int y;
};

class Propagation {
 public:
  Propagation(const Nodes& nodes, const std::vector<int>& label)
      : nodes_(nodes),
        width_(nodes.width),
        height_(static_cast<int>(nodes.size()) / nodes.width),
        best_(nodes.size()) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (label[i] >= 0) best_[i] = {static_cast<int>(i), 0.0F};
    }
  }

  void run() {
    constexpr std::array<Offset, 4> kBefore = {{{-1, 0}, {0, -1}, {-1, -1}, {1, -1}}};
    constexpr std::array<Offset, 4> kAfter = {{{1, 0}, {0, 1}, {1, 1}, {-1, 1}}};
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) visit(x, y, kBefore);
    }
    for (int y = height_ - 1; y >= 0; --y) {
      for (int x = width_ - 1; x >= 0; --x) visit(x, y, kAfter);
    }
  }

  const std::vector<Candidate>& best() const { return best_; }

 private:
  void visit(int x, int y, const std::array<Offset, 4>& offsets) {
    const auto i = static_cast<std::size_t>(y * width_ + x);
    if (best_[i].distance2 == 0.0F) return;
    const Eigen::Vector3f& point = nodes_.points[i];
    const bool has_point = point.allFinite();
    for (const Offset& offset : offsets) {
      const int u = x + offset.x;
      const int v = y + offset.y;
      if (u < 0 || u >= width_ || v < 0 || v >= height_) continue;
      const int seed = best_[static_cast<std::size_t>(v * width_ + u)].seed;
      if (seed < 0 || seed == best_[i].seed) continue;
      if (!has_point) {
        if (best_[i].seed < 0) best_[i].seed = seed;
        continue;
      }
      const float distance2 = (point - nodes_.points[static_cast<std::size_t>(seed)]).squaredNorm();
      if (distance2 < best_[i].distance2) best_[i] = {seed, distance2};
    }
  }

  const Nodes& nodes_;
  int width_;
  int height_;
  std::vector<Candidate> best_;
};

}  // namespace

std::vector<int> nearest_seeds(const Nodes& nodes, const std::vector<int>& label, float reach,
                               float noise_factor) {
  Propagation propagation(nodes, label);
  propagation.run();
  std::vector<int> seeds(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Candidate& best = propagation.best()[i];
    const float limit = reach + noise_factor * nodes.sigma[i];
    const bool is_far = nodes.points[i].allFinite() && best.distance2 > limit * limit;
    seeds[i] = is_far ? -1 : best.seed;
  }
  return seeds;
}

}  // namespace mms
