#include "mms/segmentation/solo/solo_decoder.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <span>

#include "mms/segmentation/solo/mask_logits.hpp"
#include "mms/segmentation/solo/mask_upsampling.hpp"
#include "mms/segmentation/solo/matrix_nms.hpp"

namespace mms {
namespace {

constexpr std::array<int, HeadConfig::kLevels> kStrides = {8, 8, 16, 32, 32};

/// A cell with a likely category.
struct Cell {
  int level = 0;
  int index = 0;  ///< row-major
  int category = 0;
  float score = 0.0F;
};

/// The logits of one category on one level's grid.
struct CategoryGrid {
  ChannelsLastMap map;
  int side = 0;
  int category = 0;

  float logit(int row, int column) const { return map.cell(row * side + column)[category]; }

  /// Whether no adjacent cell above or to the left has a higher logit.
  bool is_peak(int row, int column) const {
    const float own = logit(row, column);
    for (int dy = 0; dy <= std::min(1, row); ++dy) {
      for (int dx = 0; dx <= std::min(1, column); ++dx) {
        if (logit(row - dy, column - dx) > own) return false;
      }
    }
    return true;
  }
};

/// Adds the peaks that may become objects. An object's score is that of its cell times two factors
/// of at most 1, and in matrix NMS a mask affects only those with lower scores. Cells that cannot
/// reach `config.score` can therefore be skipped.
void collect_peaks(const CategoryGrid& grid, int level, const DecoderConfig& config,
                   std::vector<Cell>& cells) {
  const auto probability = static_cast<float>(config.candidate_score);
  const float least = std::log(probability / (1.0F - probability));
  for (int row = 0; row < grid.side; ++row) {
    for (int column = 0; column < grid.side; ++column) {
      const float logit = grid.logit(row, column);
      if (logit <= least || !grid.is_peak(row, column)) continue;
      const float score = sigmoid(logit);
      if (score < static_cast<float>(config.score)) continue;
      cells.push_back({level, row * grid.side + column, grid.category, score});
    }
  }
}

std::vector<Cell> likely_cells(const HeadMaps& maps, const NetworkConfig& network,
                               const DecoderConfig& config) {
  const auto grids = network.head.grids();
  std::vector<Cell> cells;
  for (int level = 0; level < HeadConfig::kLevels; ++level) {
    const auto l = static_cast<std::size_t>(level);
    for (int category = 0; category < network.classes; ++category) {
      collect_peaks({maps.categories[l], grids[l], category}, level, config, cells);
    }
  }
  const auto most = std::min(cells.size(), static_cast<std::size_t>(4 * config.candidates));
  std::partial_sort(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(most), cells.end(),
                    [](const Cell& a, const Cell& b) { return a.score > b.score; });
  cells.resize(most);
  return cells;
}

/// One row per mask, one column per pixel.
using MaskLogits = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Adds along one axis: slope u - softplus(decay) u^2, u the distance from the center of a cell.
Eigen::RowVectorXf window_along(float decay, float slope, int cell, int cells, int pixels) {
  const float step = static_cast<float>(cells) / static_cast<float>(pixels);
  const auto u =
      (Eigen::RowVectorXf::LinSpaced(pixels, 0.5F, static_cast<float>(pixels) - 0.5F) * step -
       Eigen::RowVectorXf::Constant(pixels, static_cast<float>(cell) + 0.5F))
          .array()
          .eval();
  const float softplus = std::max(decay, 0.0F) + std::log1p(std::exp(-std::abs(decay)));
  return (slope * u - softplus * u.square()).matrix();
}

/// Adds the windows of the cells (`HeadConfig::kWindowTerms`).
void add_windows(const std::vector<Cell>& cells, const HeadMaps& maps, const HeadConfig& head,
                 MaskLogits& logits) {
  using Plane = Eigen::Map<Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
  const auto grids = head.grids();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto level = static_cast<std::size_t>(cells[i].level);
    const float* terms = maps.kernels[level].cell(cells[i].index) + head.kernel_channels;
    const int side = grids[level];
    const Eigen::RowVectorXf x =
        window_along(terms[0], terms[2], cells[i].index % side, side, maps.mask_width);
    const Eigen::RowVectorXf y =
        window_along(terms[1], terms[3], cells[i].index / side, side, maps.mask_height);
    Plane plane(logits.row(static_cast<Eigen::Index>(i)).data(), maps.mask_height, maps.mask_width);
    plane.rowwise() += x;
    plane.colwise() += y.transpose();
  }
}

/// The dynamic convolution, with windows: mask logits of the cells.
MaskLogits mask_logits(const std::vector<Cell>& cells, const HeadMaps& maps,
                       const NetworkConfig& network) {
  const int channels = network.head.kernel_channels;
  MaskLogits kernels(static_cast<Eigen::Index>(cells.size()), channels);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const ChannelsLastMap& map = maps.kernels[static_cast<std::size_t>(cells[i].level)];
    std::copy_n(map.cell(cells[i].index), channels,
                kernels.row(static_cast<Eigen::Index>(i)).data());
  }
  using Features = Eigen::Map<const Eigen::MatrixXf, Eigen::Unaligned, Eigen::OuterStride<>>;
  const Features features(maps.mask_features.data, channels, maps.mask_width * maps.mask_height,
                          Eigen::OuterStride<>(maps.mask_features.pitch));
  MaskLogits logits = kernels * features;
  if (network.head.window) add_windows(cells, maps, network.head, logits);
  return logits;
}

/// A mask before suppression.
struct Candidate {
  NmsCandidate nms;
  std::span<const float> logits;  ///< of its pixels
};

/// The mask with its score times its maskness; area 0 if it is too small for its level.
Candidate candidate_of(const Cell& cell, std::span<const float> logits) {
  Candidate candidate{{cell.category, 0.0F, bit_mask(logits, 0.0F)}, logits};
  BitMask& mask = candidate.nms.mask;
  if (mask.area <= kStrides[static_cast<std::size_t>(cell.level)]) {
    mask.area = 0;
    return candidate;
  }
  const float maskness = probability_sum(logits, mask) / static_cast<float>(mask.area);
  candidate.nms.score = cell.score * std::min(1.0F, maskness);
  return candidate;
}

/// Sorts by score and keeps at most `most`.
void keep_best(std::vector<Candidate>& candidates, int most) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.nms.score > b.nms.score; });
  if (candidates.size() > static_cast<std::size_t>(most)) {
    candidates.resize(static_cast<std::size_t>(most));
  }
}

/// The masks that may become objects, highest score first.
std::vector<Candidate> candidates_of(const std::vector<Cell>& cells, const MaskLogits& logits,
                                     const DecoderConfig& config) {
  const auto pixels = static_cast<std::size_t>(logits.cols());
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    Candidate candidate = candidate_of(cells[i], {logits.data() + i * pixels, pixels});
    const bool good = candidate.nms.score >= static_cast<float>(config.score);
    if (candidate.nms.mask.area > 0 && good) candidates.push_back(std::move(candidate));
  }
  keep_best(candidates, config.candidates);
  return candidates;
}

/// Matrix NMS; the remaining ones, highest score first.
void suppress(std::vector<Candidate>& candidates, const DecoderConfig& config) {
  std::vector<NmsCandidate> competing;
  for (const Candidate& candidate : candidates) competing.push_back(candidate.nms);
  const std::vector<float> scores = matrix_nms(competing);
  for (std::size_t i = 0; i < scores.size(); ++i) candidates[i].nms.score = scores[i];
  std::erase_if(candidates, [&](const Candidate& candidate) {
    return candidate.nms.score < static_cast<float>(config.score);
  });
  keep_best(candidates, config.instances);
}

}  // namespace

void DecoderConfig::visit(ConfigVisitor& v) {
  v.number({"candidate_score", "", "smallest probability of a cell's category"}, candidate_score,
           {0.001, 0.999});
  v.number({"score", "", "smallest score after matrix NMS"}, score, {0.0, 1.0});
  v.integer({"candidates", "", "largest number before matrix NMS"}, candidates, {1, 10000});
  v.integer({"instances", "", "largest number after matrix NMS"}, instances, {1, 1000});
}

std::vector<Detection> decode(const HeadMaps& maps, const NetworkConfig& network,
                              const PreparedImage& prepared, const DecoderConfig& config) {
  const std::vector<Cell> cells = likely_cells(maps, network, config);
  if (cells.empty()) return {};
  const MaskLogits logits = mask_logits(cells, maps, network);
  std::vector<Candidate> candidates = candidates_of(cells, logits, config);
  suppress(candidates, config);
  std::vector<Detection> detections;
  for (const Candidate& candidate : candidates) {
    Detection detection =
        upsampled_mask(probabilities(candidate.logits), maps.mask_width, prepared);
    if (detection.mask.empty()) continue;
    detection.category = candidate.nms.category;
    detection.score = candidate.nms.score;
    detections.push_back(std::move(detection));
  }
  return detections;
}

}  // namespace mms
