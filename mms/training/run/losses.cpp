#include "mms/training/run/losses.hpp"

#include <torch/nn/functional.h>

#include <algorithm>
#include <cmath>

namespace mms {
namespace {

constexpr double kAlpha = 0.25;
/// Distance of normalized colors up to which neighbors have one label: about BoxInst's 2.4 in Lab.
constexpr double kSameColor = 0.12;
constexpr double kEpsilon = 1e-3;  // prevents division by zero for empty masks

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
torch::Tensor category_loss(const torch::Tensor& logits, const std::vector<ImageTargets>& targets,
                            const network::ProcessSum& sum) {
  const torch::Tensor wanted = category_targets(targets).to(logits.device());
  const torch::Tensor positive = wanted >= 0;
  const torch::Tensor one_hot =
      torch::one_hot(wanted.clamp_min(0), logits.size(2)) * positive.unsqueeze(2).to(torch::kLong);
  const torch::Tensor complete = complete_classes(targets, logits.size(2)).to(logits.device());
  const torch::Tensor counted =
      (wanted != ImageTargets::kIgnored).unsqueeze(2) * torch::maximum(complete, one_hot);
  const torch::Tensor loss = focal_loss(logits, one_hot.to(torch::kFloat)) * counted;
  const torch::Tensor cells = positive.sum();
  return loss.sum() / ((sum ? sum(cells) : cells) + 1);
}

/// At most `most`, evenly spaced.
std::vector<ImageTargets::Pair> limited_pairs(const std::vector<ImageTargets::Pair>& pairs,
                                              std::size_t most) {
  if (pairs.size() <= most) return pairs;
  std::vector<ImageTargets::Pair> some;
  for (std::size_t i = 0; i < most; ++i) {
    some.push_back(pairs[i * pairs.size() / most]);
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

/// The pairs of cell and object of a batch, in the order of the images.
struct BatchPairs {
  std::vector<std::int64_t> counts;   // of each image
  std::vector<std::int64_t> cells;    // index among the cells of all images
  std::vector<std::int64_t> objects;  // index among the objects of all images
  std::vector<std::int64_t> images;
  std::vector<std::int64_t> with_mask;  // indices of the pairs whose object has a mask
  std::vector<std::int64_t> with_box;   // and of those with a box only
  std::vector<float> cell_columns;      // of each pair
  std::vector<float> cell_rows;
  std::vector<float> grid_sides;  // [cells]
};

BatchPairs pairs_of(const std::vector<ImageTargets>& targets, std::int64_t cells_per_image,
                    std::size_t most) {
  BatchPairs all;
  std::int64_t objects = 0;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const auto image = static_cast<std::int64_t>(i);
    const auto offsets = level_offsets(targets[i]);
    const std::vector<ImageTargets::Pair> pairs = limited_pairs(targets[i].pairs, most);
    all.counts.push_back(static_cast<std::int64_t>(pairs.size()));
    for (const ImageTargets::Pair& pair : pairs) {
      const bool box_only = targets[i].box_only[static_cast<std::size_t>(pair.object)];
      (box_only ? all.with_box : all.with_mask)
          .push_back(static_cast<std::int64_t>(all.cells.size()));
      all.cells.push_back(image * cells_per_image + offsets[static_cast<std::size_t>(pair.level)] +
                          pair.cell);
      all.objects.push_back(objects + pair.object);
      all.images.push_back(image);
      const auto cells = targets[i].categories[static_cast<std::size_t>(pair.level)].size();
      const int side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(cells))));
      all.cell_columns.push_back(static_cast<float>(pair.cell % side));
      all.cell_rows.push_back(static_cast<float>(pair.cell / side));
      all.grid_sides.push_back(static_cast<float>(side));
    }
    objects += static_cast<std::int64_t>(targets[i].masks.size());
  }
  return all;
}

/// Masks of all objects, (objects, pixels) in {0, 1}.
torch::Tensor mask_targets(const std::vector<ImageTargets>& targets, std::int64_t pixels) {
  std::vector<torch::Tensor> masks;
  for (const ImageTargets& image : targets) {
    for (const Image<std::uint8_t>& mask : image.masks) {
      masks.push_back(torch::from_blob(const_cast<std::uint8_t*>(mask.pixels().data()), {pixels},
                                       torch::kByte));
    }
  }
  return torch::stack(masks);
}

/// Rows of a tensor.
torch::Tensor rows(const torch::Tensor& all, const std::vector<std::int64_t>& some) {
  return all.index_select(0, torch::tensor(some).to(all.device()));
}

/// Along one axis: slope u - softplus(decay) u^2, u the distance from the center of a pair's cell;
/// (pairs, pixels).
torch::Tensor window_along(const torch::Tensor& decay, const torch::Tensor& slope,
                           const std::vector<float>& cells, const std::vector<float>& sides,
                           std::int64_t pixels) {
  const auto column = [&](const std::vector<float>& values) {
    return torch::tensor(values).to(decay.device()).unsqueeze(1);
  };
  const torch::Tensor centers =
      (torch::arange(pixels, decay.options()) + 0.5) / static_cast<double>(pixels);
  const torch::Tensor u = centers.unsqueeze(0) * column(sides) - (column(cells) + 0.5);
  return slope * u - torch::softplus(decay) * u.square();
}

/// Logits of the windows (`HeadConfig::kWindowTerms`), (pairs, pixels).
torch::Tensor window_logits(const torch::Tensor& terms, const BatchPairs& pairs,
                            std::int64_t height, std::int64_t width) {
  const auto term = [&](std::int64_t i) { return terms.narrow(1, i, 1); };
  const torch::Tensor x =
      window_along(term(0), term(2), pairs.cell_columns, pairs.grid_sides, width);
  const torch::Tensor y = window_along(term(1), term(3), pairs.cell_rows, pairs.grid_sides, height);
  return (y.unsqueeze(2) + x.unsqueeze(1)).flatten(1);
}

/// Masks that the pairs' kernels find, (pairs, pixels).
/// @param kernels   (B, cells, E), or with a window's values after them
/// @param features  (B, E, height, width)
torch::Tensor found_masks(const torch::Tensor& kernels, const torch::Tensor& features,
                          const BatchPairs& pairs) {
  // `unbind` and `split`: the gradient of single rows would fill a tensor of full size for each.
  const std::int64_t length = features.size(1);
  const torch::Tensor all = rows(kernels.flatten(0, 1), pairs.cells);
  const auto chosen = all.narrow(1, 0, length).split_with_sizes(pairs.counts);
  const auto flat = features.flatten(2).unbind();
  std::vector<torch::Tensor> found;
  for (std::size_t i = 0; i < flat.size(); ++i) {
    if (pairs.counts[i] > 0) found.push_back(torch::mm(chosen[i], flat[i]));
  }
  const torch::Tensor logits = torch::cat(found);
  if (all.size(1) == length) return torch::sigmoid(logits);
  const torch::Tensor terms = all.narrow(1, length, HeadConfig::kWindowTerms);
  return torch::sigmoid(logits + window_logits(terms, pairs, features.size(2), features.size(3)));
}

/// Dice losses of the projections on both axes: the projection term of BoxInst.
torch::Tensor projection_loss(const torch::Tensor& probability, const torch::Tensor& box) {
  return 0.5 * (dice_loss(probability.amax(1), box.amax(1)) +
                dice_loss(probability.amax(2), box.amax(2)));
}

/// Cross-entropy of "both have one label" over neighbors of nearly equal color, of which one is in
/// the box: the pairwise term of BoxInst.
torch::Tensor pairwise_loss(const torch::Tensor& probability, const torch::Tensor& box,
                            const torch::Tensor& images,
                            const std::vector<std::int64_t>& image_of) {
  using torch::indexing::Slice;
  constexpr std::int64_t kReach = 2;  // [px of the mask features], as in BoxInst
  constexpr std::array<std::array<std::int64_t, 2>, 4> kNeighbors = {
      {{0, kReach}, {kReach, 0}, {kReach, kReach}, {kReach, -kReach}}};
  torch::Tensor sum = torch::zeros({probability.size(0)}, probability.options());
  torch::Tensor count = torch::zeros_like(sum);
  for (const auto& [dy, dx] : kNeighbors) {
    const std::int64_t height = images.size(2) - dy;
    const std::int64_t width = images.size(3) - std::abs(dx);
    const std::int64_t left = std::max<std::int64_t>(0, -dx);
    const auto here = [&](const torch::Tensor& t) {
      return t.narrow(-2, 0, height).narrow(-1, left, width);
    };
    const auto there = [&, dy = dy, dx = dx](const torch::Tensor& t) {
      return t.narrow(-2, dy, height).narrow(-1, left + dx, width);
    };
    const torch::Tensor alike =
        ((here(images) - there(images)).norm(2, {1}) < kSameColor).to(torch::kFloat);
    const torch::Tensor counted = torch::maximum(here(box), there(box)) * rows(alike, image_of);
    const torch::Tensor p = here(probability);
    const torch::Tensor q = there(probability);
    const torch::Tensor same = p * q + (1 - p) * (1 - q);
    sum = sum - (same.clamp_min(kEpsilon).log() * counted).sum({1, 2});
    count = count + counted.sum({1, 2});
  }
  return sum / count.clamp_min(1);
}

/// Mask losses of all pairs.
torch::Tensor mask_losses(const torch::Tensor& kernels, const torch::Tensor& features,
                          const std::vector<ImageTargets>& targets, const BatchPairs& pairs,
                          const torch::Tensor& images) {
  const torch::Tensor probability = found_masks(kernels, features, pairs);
  const torch::Tensor wanted =
      rows(mask_targets(targets, probability.size(1)).to(probability.device()), pairs.objects)
          .to(torch::kFloat);
  std::vector<torch::Tensor> parts;
  if (!pairs.with_mask.empty()) {
    parts.push_back(dice_loss(rows(probability, pairs.with_mask), rows(wanted, pairs.with_mask)));
  }
  if (!pairs.with_box.empty()) {
    const auto planes = [&](const torch::Tensor& all) {
      return rows(all, pairs.with_box).view({-1, features.size(2), features.size(3)});
    };
    const torch::Tensor small =
        torch::adaptive_avg_pool2d(images.to(torch::kFloat), {features.size(2), features.size(3)});
    std::vector<std::int64_t> image_of;
    for (const std::int64_t pair : pairs.with_box) {
      image_of.push_back(pairs.images[static_cast<std::size_t>(pair)]);
    }
    parts.push_back(box_loss(planes(probability), planes(wanted), small, image_of));
  }
  return torch::cat(parts);
}

}  // namespace

torch::Tensor box_loss(const torch::Tensor& probability, const torch::Tensor& box,
                       const torch::Tensor& images, const std::vector<std::int64_t>& image_of) {
  return projection_loss(probability, box) + pairwise_loss(probability, box, images, image_of);
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
                   const torch::Tensor& images, const network::ProcessSum& sum, int mask_pairs) {
  SoloLoss loss;
  loss.category = category_loss(cells_of(output.categories), targets, sum);
  const torch::Tensor kernels = cells_of(output.kernels);
  const torch::Tensor features = output.mask_features.to(torch::kFloat);
  const BatchPairs pairs = pairs_of(targets, kernels.size(1), static_cast<std::size_t>(mask_pairs));
  const torch::Tensor own = torch::tensor(static_cast<std::int64_t>(pairs.cells.size()));
  const torch::Tensor count = sum ? sum(own) : own;
  // Without objects the loss is 0, but remains a function of the network.
  loss.mask = pairs.cells.empty()
                  ? 0 * (features.sum() + kernels.sum())
                  : mask_losses(kernels, features, targets, pairs, images).sum() / count;
  return loss;
}

}  // namespace mms
