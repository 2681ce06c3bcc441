#include "mms/simulation/building/stock.hpp"

#include <algorithm>
#include <array>
#include <numbers>

#include "mms/simulation/models/mesh_shapes.hpp"

namespace mms {
namespace {

using Eigen::Vector3f;

constexpr float kPalletHeight = 0.14F;
constexpr float kPi = std::numbers::pi_v<float>;

Eigen::Isometry3f turned(float x, float y, float z, float yaw) {
  return at(x, y, z) * Eigen::AngleAxisf(yaw, Vector3f::UnitZ());
}

Material wood(RandomStream& random) {
  const float tone = random.between(0.8F, 1.1F);
  return one_colored(Pattern::kPallet, tone * Vector3f(0.72F, 0.58F, 0.40F), 0.14F, random.seed());
}

Material cardboard(RandomStream& random) {
  constexpr std::array<std::array<float, 3>, 5> kPrints = {{{0.20F, 0.22F, 0.25F},
                                                            {0.15F, 0.30F, 0.60F},
                                                            {0.65F, 0.15F, 0.12F},
                                                            {0.12F, 0.45F, 0.25F},
                                                            {0.35F, 0.22F, 0.12F}}};
  const float tone = random.between(0.85F, 1.12F);
  const auto& print = kPrints[random.below(kPrints.size())];
  Vector3f color = tone * Vector3f(0.70F, 0.54F, 0.36F);
  if (random.chance(0.12F)) color = {0.86F, 0.85F, 0.82F};
  return {Pattern::kCardboard, color, random.between(0.3F, 0.55F), Vector3f(print.data()),
          random.seed()};
}

/// Cartons in layers; some of the top layer are missing.
void add_cartons(Mesh& mesh, const Eigen::Isometry3f& T, float height, RandomStream& random) {
  const int nx = 2 + static_cast<int>(random.below(2));
  const int ny = 1 + static_cast<int>(random.below(2));
  const float size_z = random.between(0.25F, 0.5F);
  const int layers = std::max(1, static_cast<int>((height - kPalletHeight) / size_z));
  const Vector3f size(1.16F / static_cast<float>(nx), 0.78F / static_cast<float>(ny), size_z);
  for (int layer = 0; layer < layers; ++layer) {
    for (int i = 0; i < nx * ny; ++i) {
      if (layer > 0 && layer + 1 == layers && random.chance(0.3F)) continue;
      const int row = i / nx;
      const float x = (static_cast<float>(i % nx) + 0.5F) * size.x() - 0.58F;
      const float y = (static_cast<float>(row) + 0.5F) * size.y() - 0.39F;
      const float z = kPalletHeight + static_cast<float>(layer) * size_z;
      add_carton(mesh, T * turned(x, y, z, random.between(-0.03F, 0.03F)),
                 {0.96F * size.x(), 0.96F * size.y(), size.z()}, random);
    }
  }
}

void add_drums(Mesh& mesh, const Eigen::Isometry3f& T, RandomStream& random) {
  constexpr std::array<std::array<float, 3>, 4> kColors = {
      {{0.10F, 0.25F, 0.60F}, {0.15F, 0.45F, 0.20F}, {0.20F, 0.20F, 0.22F}, {0.65F, 0.30F, 0.1F}}};
  const Vector3f color(kColors[random.below(kColors.size())].data());
  const std::uint32_t material =
      mesh.add(one_colored(Pattern::kBrushed, color, 0.2F, random.seed(), 0.25F));
  for (const float x : {-0.29F, 0.29F}) {
    for (const float y : {-0.2F, 0.2F}) {
      if (y > 0.0F && random.chance(0.2F)) continue;
      constexpr std::array<Ring, 7> kDrum = {{{0.0F, 0.19F, 0.19F},
                                              {0.29F, 0.19F, 0.19F},
                                              {0.31F, 0.197F, 0.197F},
                                              {0.33F, 0.19F, 0.19F},
                                              {0.58F, 0.19F, 0.19F},
                                              {0.60F, 0.197F, 0.197F},
                                              {0.88F, 0.19F, 0.19F}}};
      add_loft(mesh, T * at(x, y, kPalletHeight), kDrum, material, 20);
    }
  }
}

void add_sacks(Mesh& mesh, const Eigen::Isometry3f& T, float height, RandomStream& random) {
  const std::uint32_t material =
      mesh.add(one_colored(Pattern::kCloth, {0.80F, 0.78F, 0.70F}, 0.2F, random.seed()));
  const int layers = std::max(1, static_cast<int>((height - kPalletHeight) / 0.16F));
  for (int layer = 0; layer < layers; ++layer) {
    for (const float x : {-0.3F, 0.3F}) {
      for (const float y : {-0.19F, 0.19F}) {
        const float z = kPalletHeight + 0.09F + 0.16F * static_cast<float>(layer);
        add_ellipsoid(mesh, T * turned(x, y, z, random.between(-0.1F, 0.1F)),
                      {0.33F, 0.22F, 0.105F}, material, 14);
      }
    }
  }
}

void add_crate(Mesh& mesh, const Eigen::Isometry3f& T, float height, RandomStream& random) {
  Material planks = one_colored(Pattern::kPlanks, {0.62F, 0.50F, 0.36F}, 0.12F, random.seed());
  if (random.chance(0.4F)) {
    planks = {Pattern::kTiles, {0.30F, 0.42F, 0.62F}, 0.2F, {0.20F, 0.30F, 0.5F}, random.seed()};
  }
  const float half = 0.5F * std::max(0.3F, height - kPalletHeight - random.between(0.0F, 0.3F));
  add_box(mesh, T * at(0.0F, 0.0F, kPalletHeight + half), {0.58F, 0.39F, half}, mesh.add(planks));
}

/// Load of one half of a bay.
void add_shelf_load(Mesh& mesh, const Eigen::Isometry3f& T, RandomStream& random) {
  if (random.chance(0.12F)) return;
  const float yaw = random.between(-0.03F, 0.03F) + (random.chance(0.5F) ? kPi : 0.0F);
  add_loaded_pallet(mesh, T * turned(0.0F, random.between(-0.06F, 0.06F), 0.0F, yaw),
                    random.between(0.6F, 1.25F), random);
}

struct RackPaint {
  std::uint32_t post;
  std::uint32_t beam;
  std::uint32_t deck;
};

RackPaint rack_paint(Mesh& mesh, RandomStream& random) {
  const Vector3f post =
      random.chance(0.7F) ? Vector3f(0.12F, 0.24F, 0.52F) : Vector3f(0.35F, 0.37F, 0.38F);
  const Vector3f beam(0.85F, 0.38F, 0.10F);
  const Vector3f deck(0.55F, 0.56F, 0.57F);
  const auto steel = [&](const Vector3f& color) {
    return mesh.add(one_colored(Pattern::kBrushed, color, 0.1F, random.seed(), 0.15F));
  };
  const std::uint32_t post_paint = steel(post);
  const std::uint32_t beam_paint = steel(beam);
  return {post_paint, beam_paint, steel(deck)};
}

/// Two posts with braces between them.
void add_frame(Mesh& mesh, const Eigen::Isometry3f& T, float height, std::uint32_t paint) {
  const float half_depth = 0.5F * kRackDepth - 0.05F;
  for (const float y : {-half_depth, half_depth}) {
    add_box(mesh, T * at(0.0F, y, 0.5F * height), {0.045F, 0.04F, 0.5F * height}, paint);
  }
  for (float z = 0.4F; z + 0.8F < height; z += 0.9F) {
    const float tilt = std::atan2(0.8F, 2.0F * half_depth);
    const Eigen::Isometry3f slanted =
        T * at(0.0F, 0.0F, z + 0.4F) * Eigen::AngleAxisf(tilt, Vector3f::UnitX());
    add_box(mesh, slanted, {0.012F, half_depth / std::cos(tilt), 0.02F}, paint);
  }
}

void add_level(Mesh& mesh, const Eigen::Isometry3f& T, float length, float z,
               const RackPaint& paint) {
  const float half_depth = 0.5F * kRackDepth - 0.05F;
  for (const float y : {-half_depth - 0.01F, half_depth + 0.01F}) {
    add_box(mesh, T * at(0.0F, y, z - 0.06F), {0.5F * length, 0.025F, 0.055F}, paint.beam);
  }
  add_box(mesh, T * at(0.0F, 0.0F, z - 0.012F), {0.5F * length, half_depth - 0.03F, 0.008F},
          paint.deck);
}

}  // namespace

void add_pallet(Mesh& mesh, const Eigen::Isometry3f& T, RandomStream& random) {
  const std::uint32_t material = mesh.add(wood(random));
  for (const float y : {-0.35F, 0.0F, 0.35F}) {
    add_box(mesh, T * at(0.0F, y, 0.055F), {0.6F, 0.05F, 0.055F}, material);
  }
  for (const float y : {-0.34F, -0.17F, 0.0F, 0.17F, 0.34F}) {
    add_box(mesh, T * at(0.0F, y, 0.125F), {0.6F, 0.06F, 0.0125F}, material);
  }
}

void add_carton(Mesh& mesh, const Eigen::Isometry3f& T, const Vector3f& size,
                RandomStream& random) {
  add_box(mesh, T * at(0.0F, 0.0F, 0.5F * size.z()), 0.5F * size, mesh.add(cardboard(random)));
}

void add_loaded_pallet(Mesh& mesh, const Eigen::Isometry3f& T, float height, RandomStream& random) {
  add_pallet(mesh, T, random);
  const float kind = random.uniform();
  if (kind < 0.62F) {
    add_cartons(mesh, T, height, random);
  } else if (kind < 0.74F) {
    add_drums(mesh, T, random);
  } else if (kind < 0.86F) {
    add_sacks(mesh, T, height, random);
  } else {
    add_crate(mesh, T, height, random);
  }
}

/// A load; each of `changes` takes some loads away or replaces them.
void add_changed_load(Mesh& mesh, const Eigen::Isometry3f& T, RandomStream& random,
                      std::span<RandomStream> changes) {
  constexpr float kMoved = 0.2F;  // share of the loads
  constexpr float kGone = 0.5F;   // share of these
  Mesh load;
  add_shelf_load(load, T, random);
  for (RandomStream& change : changes) {
    if (!change.chance(kMoved)) continue;
    load = {};
    if (!change.chance(kGone)) add_shelf_load(load, T, change);
  }
  append(mesh, load, Eigen::Isometry3f::Identity());
}

void add_rack(Mesh& mesh, const Eigen::Isometry3f& T, int bays, int levels, bool equal_loads,
              RandomStream& random, std::span<RandomStream> changes) {
  constexpr float kLevelHeight = 1.55F;
  const float length = static_cast<float>(bays) * kBayLength;
  const RackPaint paint = rack_paint(mesh, random);
  const std::uint64_t bay_seed = random.bits();
  for (int bay = 0; bay <= bays; ++bay) {
    const float x = static_cast<float>(bay) * kBayLength - 0.5F * length;
    add_frame(mesh, T * at(x, 0.0F, 0.0F), static_cast<float>(levels) * kLevelHeight, paint.post);
  }
  for (int level = 0; level < levels; ++level) {
    const float z = static_cast<float>(level) * kLevelHeight;
    if (level > 0) add_level(mesh, T, length, z, paint);
    for (int half_bay = 0; half_bay < 2 * bays; ++half_bay) {
      RandomStream own(hash_of(bay_seed, static_cast<std::uint64_t>(level)));
      const float x = (static_cast<float>(half_bay) + 0.5F) * 0.5F * kBayLength - 0.5F * length;
      add_changed_load(mesh, T * at(x, 0.0F, z), equal_loads ? own : random, changes);
    }
  }
}

}  // namespace mms
