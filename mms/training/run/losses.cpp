#include "mms/training/run/losses.hpp"

#include <torch/nn/functional.h>

#include <algorithm>

namespace mms {
namespace {

constexpr double kAlpha = 0.25;
/// Distance of normalized colors up to which neighbors have one label: about BoxInst's 2.4 in Lab.
constexpr double kSameColor = 0.12;
constexpr double kEpsilon = 1e-3;       // prevents division by zero for empty masks
constexpr std::size_t kMaxPairs = 200;  // per image: bounds memory for crowds

/// (B, C, S, S) of all levels as (B, cells, C).
torch::Tensor cells_of(const std::array<torch::Tensor, HeadConfig::kLevels>& maps) {
  std::vector<torch::Tensor> levels;
  for (const torch::Tensor& map : maps) levels.push_back(map.to(torch::kFloat).flatten(2));
  return torch::cat(levels, 2).permute({0, 2, 1});
}

/// Classes of all cells of all images, (B, cells).
torch::Tensor category_targets(const std::vector<ImageTargets>& targets) {
  std::vector<std::int64_t> all;
  for (const ImageTargets& image : targets) {
    for (const auto& level : image.categories) all.insert(all.end(), level.begin(), level.end());
  }
  return torch::tensor(all).view({static_cast<std::int64_t>(targets.size()), -1});
}

/// 1 for the classes whose objects are all annotated, (B, 1, C).
torch::Tensor complete_classes(const std::vector<ImageTargets>& targets, std::int64_t classes) {
  torch::Tensor complete = torch::ones({static_cast<std::int64_t>(targets.size()), 1, classes});
  for (std::size_t i = 0; i < targets.size(); ++i) {
    for (const int category : targets[i].partial) {
      if (category < classes) complete[static_cast<std::int64_t>(i)][0][category] = 0;
    }
  }
  return complete;
}

/// Cells on a crowd do not count, nor background cells for a class with objects not annotated.
torch::Tensor category_loss(const torch::Tensor& logits, const std::vector<ImageTargets>& targets) {
  const torch::Tensor wanted = category_targets(targets).to(logits.device());
  const torch::Tensor positive = wanted >= 0;
  const torch::Tensor one_hot =
      torch::one_hot(wanted.clamp_min(0), logits.size(2)) * positive.unsqueeze(2).to(torch::kLong);
  const torch::Tensor complete = complete_classes(targets, logits.size(2)).to(logits.device());
  const torch::Tensor counted =
      (wanted != ImageTargets::kIgnored).unsqueeze(2) * torch::maximum(complete, one_hot);
  const torch::Tensor loss = focal_loss(logits, one_hot.to(torch::kFloat)) * counted;
  return loss.sum() / (positive.sum() + 1);
}

/// At most `kMaxPairs`, evenly spaced.
std::vector<ImageTargets::Pair> limited_pairs(const std::vector<ImageTargets::Pair>& pairs) {
  if (pairs.size() <= kMaxPairs) return pairs;
  std::vector<ImageTargets::Pair> some;
  for (std::size_t i = 0; i < kMaxPairs; ++i) {
    some.push_back(pairs[i * pairs.size() / kMaxPairs]);
  }
  return some;
}

/// Index of the first cell of each level.
std::array<int, HeadConfig::kLevels> level_offsets(const ImageTargets& targets) {
  std::array<int, HeadConfig::kLevels> offsets{};
  int sum = 0;
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    offsets[i] = sum;
    sum += static_cast<int>(targets.categories[i].size());
  }
  return offsets;
}

/// Masks of an image's objects, (objects, pixels) in {0, 1}.
torch::Tensor mask_targets(const ImageTargets& targets) {
  std::vector<torch::Tensor> masks;
  for (const Image<std::uint8_t>& mask : targets.masks) {
    masks.push_back(torch::from_blob(const_cast<std::uint8_t*>(mask.pixels().data()),
                                     {static_cast<std::int64_t>(mask.size())}, torch::kByte));
  }
  return torch::stack(masks).to(torch::kFloat);
}

/// Dice losses of the projections on both axes: the projection term of BoxInst.
torch::Tensor projection_loss(const torch::Tensor& probability, const torch::Tensor& box) {
  return 0.5 * (dice_loss(probability.amax(1), box.amax(1)) +
                dice_loss(probability.amax(2), box.amax(2)));
}

/// Cross-entropy of "both have one label" over neighbors of nearly equal color, of which one is in
/// the box: the pairwise term of BoxInst.
torch::Tensor pairwise_loss(const torch::Tensor& probability, const torch::Tensor& box,
                            const torch::Tensor& image) {
  using torch::indexing::Slice;
  constexpr std::int64_t kReach = 2;  // [px of the mask features], as in BoxInst
  constexpr std::array<std::array<std::int64_t, 2>, 4> kNeighbors = {
      {{0, kReach}, {kReach, 0}, {kReach, kReach}, {kReach, -kReach}}};
  torch::Tensor sum = torch::zeros({probability.size(0)}, probability.options());
  torch::Tensor count = torch::zeros_like(sum);
  for (const auto& [dy, dx] : kNeighbors) {
    const std::int64_t height = image.size(1) - dy;
    const std::int64_t width = image.size(2) - std::abs(dx);
    const std::int64_t left = std::max<std::int64_t>(0, -dx);
    const auto here = [&](const torch::Tensor& t) {
      return t.index({Slice(), Slice(0, height), Slice(left, left + width)});
    };
    const auto there = [&, dy = dy, dx = dx](const torch::Tensor& t) {
      return t.index({Slice(), Slice(dy, dy + height), Slice(left + dx, left + dx + width)});
    };
    const torch::Tensor alike =
        ((here(image) - there(image)).norm(2, {0}) < kSameColor).to(torch::kFloat);
    const torch::Tensor counted = torch::maximum(here(box), there(box)) * alike.unsqueeze(0);
    const torch::Tensor p = here(probability);
    const torch::Tensor q = there(probability);
    const torch::Tensor same = p * q + (1 - p) * (1 - q);
    sum = sum - (same.clamp_min(kEpsilon).log() * counted).sum({1, 2});
    count = count + counted.sum({1, 2});
  }
  return sum / count.clamp_min(1);
}

/// Mask losses of one image's pairs.
/// @param image  (3, height, width) at the size of the features, normalized
torch::Tensor image_mask_loss(const torch::Tensor& kernels, const torch::Tensor& features,
                              const ImageTargets& targets, const torch::Tensor& image) {
  const auto offsets = level_offsets(targets);
  std::vector<std::int64_t> cells;
  std::vector<std::int64_t> objects;
  std::vector<std::int64_t> boxes;  // indices of the pairs with a box only
  std::vector<std::int64_t> masks;
  for (const ImageTargets::Pair& pair : limited_pairs(targets.pairs)) {
    cells.push_back(offsets[static_cast<std::size_t>(pair.level)] + pair.cell);
    const bool box_only = targets.box_only[static_cast<std::size_t>(pair.object)];
    (box_only ? boxes : masks).push_back(static_cast<std::int64_t>(objects.size()));
    objects.push_back(pair.object);
  }
  const auto device = features.device();
  const torch::Tensor chosen = kernels.index_select(0, torch::tensor(cells).to(device));
  const torch::Tensor probability = torch::sigmoid(torch::mm(chosen, features.flatten(1)));
  const torch::Tensor wanted =
      mask_targets(targets).to(device).index_select(0, torch::tensor(objects).to(device));
  if (boxes.empty()) return dice_loss(probability, wanted);
  const auto rows = [&](const torch::Tensor& all, const std::vector<std::int64_t>& some) {
    return all.index_select(0, torch::tensor(some).to(device));
  };
  const auto planes = [&](const torch::Tensor& all) {
    return rows(all, boxes).view({-1, features.size(1), features.size(2)});
  };
  const torch::Tensor found = planes(probability);
  const torch::Tensor box = planes(wanted);
  const torch::Tensor of_boxes = box_loss(found, box, image);
  if (masks.empty()) return of_boxes;
  return torch::cat({dice_loss(rows(probability, masks), rows(wanted, masks)), of_boxes});
}

}  // namespace

torch::Tensor box_loss(const torch::Tensor& probability, const torch::Tensor& box,
                       const torch::Tensor& image) {
  return projection_loss(probability, box) + pairwise_loss(probability, box, image);
}

torch::Tensor dice_loss(const torch::Tensor& probability, const torch::Tensor& target) {
  const torch::Tensor common = (probability * target).sum(1);
  const torch::Tensor squares = probability.square().sum(1) + target.square().sum(1) + 2 * kEpsilon;
  return 1 - 2 * common / squares;
}

torch::Tensor focal_loss(const torch::Tensor& logits, const torch::Tensor& target) {
  const torch::Tensor p = torch::sigmoid(logits);
  const torch::Tensor missed = target * (1 - p) + (1 - target) * p;  // 1 - p_t
  const torch::Tensor alpha = target * kAlpha + (1 - target) * (1 - kAlpha);
  const torch::Tensor entropy =
      torch::binary_cross_entropy_with_logits(logits, target, {}, {}, at::Reduction::None);
  return alpha * missed.square() * entropy;
}

SoloLoss solo_loss(const network::HeadOutput& output, const std::vector<ImageTargets>& targets,
                   const torch::Tensor& images) {
  SoloLoss loss;
  loss.category = category_loss(cells_of(output.categories), targets);
  const torch::Tensor kernels = cells_of(output.kernels);
  const torch::Tensor features = output.mask_features.to(torch::kFloat);
  const torch::Tensor small =
      torch::adaptive_avg_pool2d(images.to(torch::kFloat), {features.size(2), features.size(3)});
  std::vector<torch::Tensor> parts;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (targets[i].pairs.empty()) continue;
    const auto image = static_cast<std::int64_t>(i);
    parts.push_back(image_mask_loss(kernels[image], features[image], targets[i], small[image]));
  }
  // Without objects the loss is 0, but remains a function of the network.
  loss.mask = parts.empty() ? 0 * (features.sum() + kernels.sum()) : torch::cat(parts).mean();
  return loss;
}

}  // namespace mms
