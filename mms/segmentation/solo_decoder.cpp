#include "mms/segmentation/solo_decoder.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "mms/segmentation/mask_enlargement.hpp"
#include "mms/segmentation/matrix_nms.hpp"

namespace mms {
namespace {

constexpr float kMaskThreshold = 0.5F;  // of a pixel's probability
constexpr std::array<int, HeadConfig::kLevels> kStrides = {8, 8, 16, 32, 32};

/// A cell whose category is likely.
struct Cell {
  int level = 0;
  int index = 0;  ///< row-major
  int category = 0;
  float score = 0.0F;
};

float sigmoid(float x) {
  return 1.0F / (1.0F + std::exp(-x));
}

/// Whether no cell above, to the left or between has a higher logit.
bool is_peak(const float* logits, int side, int row, int column) {
  const float own = logits[row * side + column];
  for (int dy = 0; dy <= std::min(1, row); ++dy) {
    for (int dx = 0; dx <= std::min(1, column); ++dx) {
      if (logits[(row - dy) * side + column - dx] > own) return false;
    }
  }
  return true;
}

void collect_peaks(const float* logits, int side, int level, int category, float least,
                   std::vector<Cell>& cells) {
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const int index = row * side + column;
      if (logits[index] <= least || !is_peak(logits, side, row, column)) continue;
      cells.push_back({level, index, category, sigmoid(logits[index])});
    }
  }
}

std::vector<Cell> likely_cells(const HeadMaps& maps, const NetworkConfig& network,
                               const DecoderConfig& config) {
  const auto probability = static_cast<float>(config.candidate_score);
  const float least = std::log(probability / (1.0F - probability));
  const auto grids = network.head.grids();
  std::vector<Cell> cells;
  for (int level = 0; level < HeadConfig::kLevels; ++level) {
    const auto l = static_cast<std::size_t>(level);
    const int side = grids[l];
    for (int category = 0; category < network.classes; ++category) {
      collect_peaks(maps.categories[l] + category * side * side, side, level, category, least,
                    cells);
    }
  }
  const auto most = std::min(cells.size(), static_cast<std::size_t>(4 * config.candidates));
  std::partial_sort(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(most), cells.end(),
                    [](const Cell& a, const Cell& b) { return a.score > b.score; });
  cells.resize(most);
  return cells;
}

using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Mask probabilities, a row a cell: the dynamic convolution.
RowMajor soft_masks(const std::vector<Cell>& cells, const HeadMaps& maps,
                    const NetworkConfig& network) {
  const auto grids = network.head.grids();
  const int channels = network.head.kernel_channels;
  RowMajor kernels(static_cast<Eigen::Index>(cells.size()), channels);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto level = static_cast<std::size_t>(cells[i].level);
    const int area = grids[level] * grids[level];
    for (int c = 0; c < channels; ++c) {
      kernels(static_cast<Eigen::Index>(i), c) = maps.kernels[level][c * area + cells[i].index];
    }
  }
  const Eigen::Map<const RowMajor> features(maps.mask_features, channels,
                                            maps.mask_width * maps.mask_height);
  RowMajor logits = kernels * features;
  return (1.0F / (1.0F + (-logits.array()).exp())).matrix();
}

struct Candidate {
  NmsCandidate nms;
  std::vector<float> soft;  ///< mask probabilities
};

/// The mask with its score times its maskness; area 0 when it is too small for its level.
Candidate candidate_of(const Cell& cell, const float* soft, std::size_t size) {
  Candidate candidate;
  candidate.soft.assign(soft, soft + size);
  candidate.nms = {cell.category, 0.0F, bit_mask(candidate.soft, kMaskThreshold)};
  if (candidate.nms.mask.area <= kStrides[static_cast<std::size_t>(cell.level)]) {
    candidate.nms.mask.area = 0;
    return candidate;
  }
  float sum = 0.0F;
  for (const float value : candidate.soft) sum += value > kMaskThreshold ? value : 0.0F;
  candidate.nms.score = cell.score * sum / static_cast<float>(candidate.nms.mask.area);
  return candidate;
}

std::vector<Candidate> candidates_of(const HeadMaps& maps, const NetworkConfig& network,
                                     const DecoderConfig& config) {
  const std::vector<Cell> cells = likely_cells(maps, network, config);
  const RowMajor soft = soft_masks(cells, maps, network);
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    Candidate candidate = candidate_of(cells[i], soft.data() + row * soft.cols(),
                                       static_cast<std::size_t>(soft.cols()));
    if (candidate.nms.mask.area > 0) candidates.push_back(std::move(candidate));
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.nms.score > b.nms.score; });
  if (candidates.size() > static_cast<std::size_t>(config.candidates)) {
    candidates.resize(static_cast<std::size_t>(config.candidates));
  }
  return candidates;
}

/// Lets better masks suppress worse ones; what is left, best first.
void suppress(std::vector<Candidate>& candidates, const DecoderConfig& config) {
  std::vector<NmsCandidate> competing;
  for (const Candidate& candidate : candidates) competing.push_back(candidate.nms);
  const std::vector<float> scores = matrix_nms(competing);
  for (std::size_t i = 0; i < scores.size(); ++i) candidates[i].nms.score = scores[i];
  std::erase_if(candidates, [&](const Candidate& candidate) {
    return candidate.nms.score < static_cast<float>(config.score);
  });
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.nms.score > b.nms.score; });
  if (candidates.size() > static_cast<std::size_t>(config.instances)) {
    candidates.resize(static_cast<std::size_t>(config.instances));
  }
}

}  // namespace

void DecoderConfig::visit(ConfigVisitor& v) {
  v.number({"candidate_score", "", "smallest probability of a cell's category"}, candidate_score,
           {0.001, 0.999});
  v.number({"score", "", "smallest score after matrix NMS"}, score, {0.0, 1.0});
  v.integer({"candidates", "", "at most, before matrix NMS"}, candidates, {1, 10000});
  v.integer({"instances", "", "at most, after it"}, instances, {1, 1000});
}

std::vector<Detection> decode(const HeadMaps& maps, const NetworkConfig& network,
                              const PreparedImage& prepared, const DecoderConfig& config) {
  std::vector<Candidate> candidates = candidates_of(maps, network, config);
  suppress(candidates, config);
  std::vector<Detection> detections;
  for (const Candidate& candidate : candidates) {
    Detection detection = enlarged_mask(candidate.soft, maps.mask_width, prepared);
    if (detection.mask.empty()) continue;
    detection.category = candidate.nms.category;
    detection.score = candidate.nms.score;
    detections.push_back(std::move(detection));
  }
  return detections;
}

}  // namespace mms
