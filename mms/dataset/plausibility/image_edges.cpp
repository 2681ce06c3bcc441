#include "mms/dataset/plausibility/image_edges.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mms {
namespace {

/// [-]: a jump of the depth between neighbors is an edge from this share of the depth on.
constexpr float kJump = 0.05F;
/// [-]: and from this multiple of the change of the depth on both sides on, which noise is not.
constexpr float kStep = 4.0F;
/// Evenly spread edges used of one frame; more do not change the score.
constexpr std::size_t kMaxEdges = 4000;

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

Image<float> gradient_ranks(const Image<Rgb>& color) {
  return maximum_of_3x3(ranks_of(gradient_of(half_gray(color))));
}

void keep_evenly_spread(std::vector<EdgePixel>& edges) {
  if (edges.size() <= kMaxEdges) return;
  for (std::size_t i = 0; i < kMaxEdges; ++i) edges[i] = edges[i * edges.size() / kMaxEdges];
  edges.resize(kMaxEdges);
}

}  // namespace

ImageEdges mask_edges(const Image<Rgb>& color, const Image<std::uint8_t>& mask) {
  ImageEdges frame{gradient_ranks(color), {}};
  for (int y = 0; y + 1 < frame.gradient.height(); ++y) {
    for (int x = 0; x + 1 < frame.gradient.width(); ++x) {
      const std::uint8_t label = mask(2 * x, 2 * y);
      if (label == mask(2 * x + 2, 2 * y) && label == mask(2 * x, 2 * y + 2)) continue;
      frame.edges.push_back({static_cast<float>(x), static_cast<float>(y)});
    }
  }
  keep_evenly_spread(frame.edges);
  return frame;
}

ImageEdges depth_edges(const Image<Rgb>& color, const Image<float>& depth) {
  ImageEdges frame{gradient_ranks(color), {}};
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
  keep_evenly_spread(frame.edges);
  return frame;
}

EdgeScore score_edges(const std::vector<EdgePixel>& edges, const Image<float>& gradient,
                      const EdgeWarp& warp) {
  EdgeScore score;
  const float center_x = 0.5F * static_cast<float>(gradient.width() - 1);
  const float center_y = 0.5F * static_cast<float>(gradient.height() - 1);
  for (const EdgePixel& edge : edges) {
    const auto x =
        static_cast<int>(std::lround((edge.x - center_x) * warp.scale_x + center_x + warp.shift_x));
    const auto y =
        static_cast<int>(std::lround((edge.y - center_y) * warp.scale_y + center_y + warp.shift_y));
    if (x < 0 || x >= gradient.width() || y < 0 || y >= gradient.height()) continue;
    score.sum += gradient(x, y);
    ++score.count;
  }
  return score;
}

}  // namespace mms
