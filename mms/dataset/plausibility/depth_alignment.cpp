#include "mms/dataset/plausibility/depth_alignment.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mms {
namespace {

// All limits come from the three real recordings and eight simulated scenes of docs/results.md,
// with right depth, mirrored, upside down, and seen by a second camera 2.5 cm beside with 0.92 of
// the focal length (mean rank of 8 frames each).

/// [-]: a jump of the depth between neighbors is an edge from this share of the depth on.
constexpr float kJump = 0.05F;
/// [-]: and from this multiple of the change of the depth on both sides on, which noise is not.
constexpr float kStep = 4.0F;
/// Fewer edges prove nothing. The scene with the fewest, `corridor`, has 535 in 8 frames.
constexpr std::size_t kMinEdges = 300;
/// Edges used of one frame; more do not change the score.
constexpr std::size_t kMaxEdges = 4000;
/// [-]: gain of a mirrored image. Right depth: at most -0.07; mirrored: at least 0.05.
constexpr double kMirrorGain = 0.04;
/// [-]: gain of a warped image. Right depth: at most 0.002; unregistered: at least 0.06.
constexpr double kWarpGain = 0.04;
/// [-]: score that shows any alignment. Right depth: at least 0.81; edges anywhere: 0.65 to 0.74.
constexpr double kMinScore = 0.76;
/// [px]: least shift at the same scale. Depth measured 20 ms later than color moves by up to 8 px
/// in `fr1_xyz_clip`; cameras side by side differ by more, or in scale.
constexpr float kMinShift = 12.0F;

/// Half the resolution, gray.
Image<float> half_gray(const Image<Rgb>& color) {
  Image<float> gray(color.width() / 2, color.height() / 2);
  const auto sum = [](const Rgb& c) { return static_cast<float>(c.r + c.g + c.b); };
  for (int y = 0; y < gray.height(); ++y) {
    for (int x = 0; x < gray.width(); ++x) {
      gray(x, y) = sum(color(2 * x, 2 * y)) + sum(color(2 * x + 1, 2 * y)) +
                   sum(color(2 * x, 2 * y + 1)) + sum(color(2 * x + 1, 2 * y + 1));
    }
  }
  return gray;
}

Image<float> gradient_of(const Image<float>& gray) {
  Image<float> gradient(gray.width(), gray.height());
  for (int y = 1; y + 1 < gray.height(); ++y) {
    for (int x = 1; x + 1 < gray.width(); ++x) {
      gradient(x, y) = std::hypot(gray(x + 1, y) - gray(x - 1, y), gray(x, y + 1) - gray(x, y - 1));
    }
  }
  return gradient;
}

/// Share of the pixels with a smaller value.
Image<float> ranks_of(const Image<float>& image) {
  std::vector<std::size_t> order(image.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return image[a] < image[b]; });
  Image<float> ranks(image.width(), image.height());
  for (std::size_t i = 0; i < order.size(); ++i) {
    ranks[order[i]] = static_cast<float>(i) / static_cast<float>(order.size());
  }
  return ranks;
}

Image<float> maximum_of_3x3(const Image<float>& image) {
  Image<float> result(image.width(), image.height());
  for (int y = 1; y + 1 < image.height(); ++y) {
    for (int x = 1; x + 1 < image.width(); ++x) {
      float most = 0.0F;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) most = std::max(most, image(x + dx, y + dy));
      }
      result(x, y) = most;
    }
  }
  return result;
}

}  // namespace

struct DepthAlignment::Warp {
  float scale_x = 1.0F;  ///< about the center; negative: mirrored
  float scale_y = 1.0F;
  float shift_x = 0.0F;  ///< [px] at half the resolution
  float shift_y = 0.0F;
};

void DepthAlignment::add(const Image<Rgb>& color, const Image<float>& depth) {
  if (color.width() != depth.width() || color.height() != depth.height()) return;
  Frame frame{maximum_of_3x3(ranks_of(gradient_of(half_gray(color)))), {}};
  const auto at = [&](int x, int y) { return depth(2 * x, 2 * y); };
  const auto is_valid = [](float d) { return std::isfinite(d) && d > 0.0F; };
  // The step from x, y to its neighbor in direction dx, dy.
  const auto add_edge = [&](int x, int y, int dx, int dy) {
    const float before = at(x - dx, y - dy);
    const float a = at(x, y);
    const float b = at(x + dx, y + dy);
    const float after = at(x + 2 * dx, y + 2 * dy);
    if (!is_valid(before) || !is_valid(a) || !is_valid(b) || !is_valid(after)) return;
    const float step = std::abs(a - b);
    const float bend = std::max(std::abs(before - a), std::abs(b - after));
    if (step <= kJump * std::min(a, b) || step <= kStep * bend) return;
    const bool first_is_nearer = a < b;
    frame.edges.push_back({static_cast<float>(first_is_nearer ? x : x + dx),
                           static_cast<float>(first_is_nearer ? y : y + dy)});
  };
  for (int y = 1; y + 2 < frame.gradient.height(); ++y) {
    for (int x = 1; x + 2 < frame.gradient.width(); ++x) {
      add_edge(x, y, 1, 0);
      add_edge(x, y, 0, 1);
    }
  }
  if (frame.edges.size() > kMaxEdges) {  // evenly spread ones
    for (std::size_t i = 0; i < kMaxEdges; ++i) {
      frame.edges[i] = frame.edges[i * frame.edges.size() / kMaxEdges];
    }
    frame.edges.resize(kMaxEdges);
  }
  edges_ += frame.edges.size();
  frames_.push_back(std::move(frame));
}

double DepthAlignment::score(const Warp& warp) const {
  double sum = 0.0;
  std::size_t count = 0;
  for (const Frame& frame : frames_) {
    const float center_x = 0.5F * static_cast<float>(frame.gradient.width() - 1);
    const float center_y = 0.5F * static_cast<float>(frame.gradient.height() - 1);
    for (const Edge& edge : frame.edges) {
      const auto x = static_cast<int>(
          std::lround((edge.x - center_x) * warp.scale_x + center_x + warp.shift_x));
      const auto y = static_cast<int>(
          std::lround((edge.y - center_y) * warp.scale_y + center_y + warp.shift_y));
      if (x < 0 || x >= frame.gradient.width() || y < 0 || y >= frame.gradient.height()) continue;
      sum += frame.gradient(x, y);
      ++count;
    }
  }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

/// Scale and shift within which depth cameras differ from the color camera beside them.
std::optional<std::string> DepthAlignment::unregistered(double score_as_is) const {
  Warp best;
  double best_score = 0.0;
  for (const float scale : {0.8F, 0.85F, 0.9F, 0.95F, 1.0F, 1.05F, 1.1F, 1.15F, 1.25F}) {
    for (int dx = -12; dx <= 12; dx += 2) {
      for (int dy = -6; dy <= 6; dy += 2) {
        const Warp warp{scale, scale, static_cast<float>(dx), static_cast<float>(dy)};
        const double found = score(warp);
        if (found > best_score) {
          best_score = found;
          best = warp;
        }
      }
    }
  }
  if (best_score < std::max(kMinScore, score_as_is + kWarpGain)) return std::nullopt;
  if (best.scale_x == 1.0F && 2.0F * std::hypot(best.shift_x, best.shift_y) < kMinShift) {
    return std::nullopt;
  }
  const int percent = static_cast<int>(std::lround(100.0F * best.scale_x));
  return "not registered: its edges fit the color images best if scaled to " +
         std::to_string(percent) + " % and moved by " +
         std::to_string(static_cast<int>(2.0F * best.shift_x)) + ", " +
         std::to_string(static_cast<int>(2.0F * best.shift_y)) + " px";
}

std::optional<std::string> DepthAlignment::fault() const {
  if (edges_ < kMinEdges) return std::nullopt;
  struct Turn {
    Warp warp;
    const char* name = "";
  };
  const Turn turns[] = {{{-1.0F, 1.0F}, "mirrored left to right"},
                        {{1.0F, -1.0F}, "mirrored top to bottom"},
                        {{-1.0F, -1.0F}, "turned by 180 degrees"}};
  const double as_is = score({});
  const Turn* best = nullptr;
  double best_score = std::max(kMinScore, as_is + kMirrorGain);
  for (const Turn& turn : turns) {
    const double found = score(turn.warp);
    if (found <= best_score) continue;
    best_score = found;
    best = &turn;
  }
  std::optional<std::string> warped = unregistered(as_is);
  if (best == nullptr) return warped;
  return best->name;
}

}  // namespace mms
