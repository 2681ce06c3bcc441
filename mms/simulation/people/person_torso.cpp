#include <algorithm>
#include <cmath>
#include <vector>

#include "mms/core/hash_noise.hpp"
#include "mms/simulation/people/person_parts.hpp"
#include "mms/simulation/people/person_shapes.hpp"

namespace mms {
namespace {

/// Outline of a shirt, as shares of the body's height above the waist.
const std::vector<Ring> kTorso = {
    {-0.066F, 0.074F, 0.108F, -0.005F}, {-0.035F, 0.070F, 0.103F, -0.005F},
    {0.020F, 0.064F, 0.091F, 0.002F},   {0.080F, 0.066F, 0.094F, 0.004F},
    {0.140F, 0.070F, 0.102F, 0.002F},   {0.185F, 0.066F, 0.106F, -0.003F},
    {0.210F, 0.058F, 0.108F, -0.007F},  {0.230F, 0.048F, 0.101F, -0.010F},
    {0.247F, 0.040F, 0.072F, -0.010F},  {0.261F, 0.035F, 0.043F, -0.007F}};

bool between(float value, float low, float high) {
  return value > low && value < high;
}

/// Openings of a vest: at the arms and in a V below the chin.
bool outside_vest(float z, float angle, float height) {
  const float across = std::abs(std::sin(angle));
  const bool front = std::cos(angle) > 0.0F;
  if (z > 0.247F * height) return true;
  if (front && across < 8.0F * (z / height - 0.190F)) return true;
  return z > 0.150F * height && across > 0.93F;
}

/// Two bands around the torso and one over each shoulder.
bool on_band(float z, float angle, float height) {
  const float share = z / height;
  if (between(share, -0.040F, -0.014F) || between(share, 0.052F, 0.078F)) return true;
  return share > 0.078F && between(std::abs(std::sin(angle)), 0.52F, 0.78F);
}

/// The shirt is open slightly below the chin.
bool collar(float z, float angle, float height) {
  return std::cos(angle) > 0.0F && std::abs(std::sin(angle)) < 9.0F * (z / height - 0.197F);
}

}  // namespace

Material cloth(const Eigen::Vector3f& color, std::uint32_t seed) {
  Material material;
  material.pattern = Pattern::kCloth;
  material.color = color;
  material.seed = seed;
  return material;
}

Material skin_of(const PersonStyle& style) {
  Material material;
  material.color = style.skin;
  material.scale = 0.05F;
  material.seed = style.seed;
  material.gloss = 0.03F;
  return material;
}

Material reflective_band() {
  Material material;
  material.pattern = Pattern::kBrushed;
  material.color = {0.82F, 0.84F, 0.85F};
  material.gloss = 0.5F;
  return material;
}

Mesh make_pelvis(const PersonStyle& style, const PersonProportions& body) {
  Mesh mesh;
  const std::uint32_t trousers = mesh.add(cloth(style.trousers, style.seed + 1));
  std::vector<Ring> rings = {{-0.058F, 0.020F, 0.030F, -0.004F},
                             {-0.045F, 0.044F, 0.066F, -0.004F},
                             {-0.020F, 0.058F, 0.089F, -0.005F},
                             {0.010F, 0.058F, 0.090F, -0.004F},
                             {0.035F, 0.052F, 0.082F, 0.0F}};
  for (Ring& ring : rings) ring.ry *= std::sqrt(body.build);
  rings = rounded_rings(scaled_rings(smooth_rings(rings, 0.02F), body.height));
  add_loft(mesh, at(0, 0, 0), rings, trousers, 14);
  return mesh;
}

Mesh make_torso(const PersonStyle& style, const PersonProportions& body) {
  Mesh mesh;
  const std::uint32_t shirt = mesh.add(cloth(style.shirt, style.seed + 2));
  const std::uint32_t skin = mesh.add(skin_of(style));
  Material bright = cloth(style.vest_color, style.seed + 3);
  bright.gloss = 0.05F;
  const std::uint32_t vest = mesh.add(bright);
  const std::uint32_t band = mesh.add(reflective_band());
  std::vector<Ring> rings = smooth_rings(kTorso, 0.0125F);
  for (Ring& ring : rings) {
    const float wider = std::max(0.0F, body.build - 1.0F) * (ring.z < 0.1F ? 1.0F - ring.z : 0.9F);
    ring.rx *= 1.0F + 1.1F * wider;
    ring.ry *= std::sqrt(body.build) * (style.vest ? 1.025F : 1.0F);
  }
  const float height = body.height;
  const Paint paint = [=](float z, float angle) {
    if (!style.vest || outside_vest(z, angle, height)) {
      return collar(z, angle, height) ? skin : shirt;
    }
    return on_band(z, angle, height) ? band : vest;
  };
  add_painted_loft(mesh, scaled_rings(rings, height), paint, 22);
  return mesh;
}

Eigen::Vector3f carried_box_half(const PersonStyle& style) {
  const auto size = [&](std::uint64_t what, float low, float high) {
    return low + (high - low) * uniform_of(hash_of(style.seed, what));
  };
  return {size(1, 0.12F, 0.17F), size(2, 0.16F, 0.23F), size(3, 0.09F, 0.16F)};
}

Eigen::Vector3f carried_box_center(const PersonStyle& style, const PersonProportions& body) {
  const Eigen::Vector3f half = carried_box_half(style);
  const float belly = 0.072F * body.height * std::max(1.0F, 1.1F * body.build);
  return {belly + half.x() + 0.02F, 0.0F, 0.03F * body.height + half.z() - 0.05F};
}

Mesh make_carried_box(const PersonStyle& style, const PersonProportions& body) {
  Mesh mesh;
  Material board;
  board.pattern = Pattern::kCardboard;
  board.color = {0.66F, 0.50F, 0.32F};
  board.second = {0.15F, 0.25F, 0.5F};
  board.scale = 0.3F;
  board.seed = style.seed + 4;
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  T.translation() = carried_box_center(style, body);
  add_box(mesh, T, carried_box_half(style), mesh.add(board));
  return mesh;
}

}  // namespace mms
