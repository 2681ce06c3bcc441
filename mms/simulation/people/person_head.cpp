#include <cmath>
#include <vector>

#include "mms/simulation/people/person_parts.hpp"
#include "mms/simulation/people/person_shapes.hpp"

namespace mms {
namespace {

// All lengths are for a height of 1.75 m; the origin is the base of the neck.
constexpr float kChin = 0.058F;
constexpr float kTop = 0.287F;

Material plain(const Eigen::Vector3f& color, float gloss) {
  Material material;
  material.color = color;
  material.gloss = gloss;
  return material;
}

/// All parts of the head are built for a height of 1.75 m and scaled at the end.
struct HeadMaterials {
  std::uint32_t skin, hair, white, dark, lips, hat;
};

HeadMaterials add_materials(Mesh& mesh, const PersonStyle& style) {
  HeadMaterials materials{};
  materials.skin = mesh.add(skin_of(style));
  Material hair = cloth(style.hair, style.seed + 5);
  hair.gloss = 0.08F;
  materials.hair = mesh.add(hair);
  materials.white = mesh.add(plain({0.88F, 0.87F, 0.85F}, 0.1F));
  materials.dark = mesh.add(plain({0.07F, 0.05F, 0.04F}, 0.1F));
  const Eigen::Vector3f red(0.55F, 0.22F, 0.20F);
  materials.lips = mesh.add(plain(0.55F * style.skin + 0.4F * red, 0.05F));
  const bool hard = style.headwear == Headwear::kHardHat;
  materials.hat = mesh.add(hard ? plain(style.hat, 0.15F) : cloth(style.hat, style.seed + 6));
  return materials;
}

void add_skull(Mesh& mesh, const HeadMaterials& materials) {
  const std::vector<Ring> neck = {{-0.05F, 0.062F, 0.066F, -0.012F},
                                  {0.0F, 0.058F, 0.059F, -0.006F},
                                  {0.05F, 0.057F, 0.056F, 0.0F},
                                  {0.11F, 0.060F, 0.058F, 0.0F}};
  add_loft(mesh, at(0, 0, 0), smooth_rings(neck, 0.06F), materials.skin, 14);
  const std::vector<Ring> head = {
      {kChin, 0.020F, 0.020F, 0.058F},          {kChin + 0.006F, 0.034F, 0.030F, 0.050F},
      {kChin + 0.03F, 0.066F, 0.049F, 0.030F},  {kChin + 0.07F, 0.086F, 0.064F, 0.014F},
      {kChin + 0.11F, 0.096F, 0.071F, 0.005F},  {kChin + 0.15F, 0.099F, 0.075F, 0.0F},
      {kChin + 0.19F, 0.088F, 0.068F, -0.003F}, {kChin + 0.215F, 0.062F, 0.050F, -0.004F},
      {kTop - 0.004F, 0.036F, 0.030F, -0.005F}, {kTop, 0.004F, 0.004F, -0.005F}};
  const Paint scalp = [&](float z, float angle) {
    const float front = 0.185F - 0.017F * std::abs(std::sin(angle));
    const float line = std::cos(angle) < -0.2F ? 0.04F : front;
    return z > kChin + line ? materials.hair : materials.skin;
  };
  add_painted_loft(mesh, smooth_rings(head, 0.03F), scalp, 16);
}

void add_face(Mesh& mesh, const HeadMaterials& materials) {
  const float eyes = kChin + 0.117F;
  const std::vector<Ring> nose = {{kChin + 0.068F, 0.006F, 0.010F, 0.100F},
                                  {kChin + 0.076F, 0.017F, 0.017F, 0.102F},
                                  {kChin + 0.09F, 0.014F, 0.011F, 0.102F},
                                  {kChin + 0.122F, 0.008F, 0.007F, 0.097F}};
  add_loft(mesh, at(0, 0, 0), smooth_rings(nose, 0.015F), materials.skin, 8);
  for (const float side : {-1.0F, 1.0F}) {
    const float y = 0.031F * side;
    add_ellipsoid(mesh, at(0.082F, y, eyes), {0.010F, 0.014F, 0.0065F}, materials.white, 8);
    add_ellipsoid(mesh, at(0.0875F, y, eyes), {0.0062F, 0.0065F, 0.0065F}, materials.dark, 6);
    const Eigen::Isometry3f brow =
        at(0.088F, 1.05F * y, eyes + 0.021F) * turned(0.35F * side, Eigen::Vector3f::UnitZ());
    add_ellipsoid(mesh, brow, {0.007F, 0.020F, 0.0045F}, materials.hair, 6);
    const Eigen::Isometry3f ear =
        at(-0.004F, 0.073F * side, eyes - 0.012F) * turned(-0.3F * side, Eigen::Vector3f::UnitZ());
    add_ellipsoid(mesh, ear, {0.017F, 0.010F, 0.031F}, materials.skin, 8);
  }
  add_ellipsoid(mesh, at(0.090F, 0, kChin + 0.043F), {0.0115F, 0.023F, 0.0065F}, materials.lips, 8);
}

void add_hair(Mesh& mesh, const HeadMaterials& materials, float volume) {
  const Eigen::Isometry3f T =
      at(-0.017F, 0, kChin + 0.148F) * turned(-0.16F, Eigen::Vector3f::UnitY());
  const float wide = 1.0F + volume;
  add_ellipsoid(mesh, T, {0.102F * wide, 0.080F * wide, 0.086F * wide}, materials.hair, 14);
  const std::vector<Ring> nape = {{kChin + 0.01F, 0.035F, 0.050F, -0.030F},
                                  {kChin + 0.06F, 0.062F, 0.068F, -0.036F},
                                  {kChin + 0.13F, 0.075F, 0.076F * wide, -0.034F}};
  add_loft(mesh, at(0, 0, 0), smooth_rings(nape, 0.04F), materials.hair, 12);
}

void add_long_hair(Mesh& mesh, const HeadMaterials& materials) {
  add_hair(mesh, materials, 0.07F);
  const std::vector<Ring> fall = {
      {-0.075F, 0.016F, 0.055F, -0.093F}, {-0.05F, 0.030F, 0.078F, -0.090F},
      {0.02F, 0.043F, 0.088F, -0.074F},   {0.10F, 0.060F, 0.089F, -0.056F},
      {0.20F, 0.075F, 0.086F, -0.034F},   {0.26F, 0.050F, 0.060F, -0.025F}};
  add_loft(mesh, at(0, 0, 0), smooth_rings(fall, 0.04F), materials.hair, 12);
}

void add_hard_hat(Mesh& mesh, const HeadMaterials& materials) {
  const Eigen::Isometry3f T =
      at(-0.004F, 0, kChin + 0.158F) * turned(-0.08F, Eigen::Vector3f::UnitY());
  const std::vector<Ring> shell = {
      {-0.004F, 0.124F, 0.102F, 0.0F},   {0.004F, 0.125F, 0.103F, 0.0F},
      {0.007F, 0.114F, 0.094F, 0.0F},    {0.035F, 0.109F, 0.090F, 0.0F},
      {0.065F, 0.091F, 0.075F, -0.002F}, {0.084F, 0.062F, 0.052F, -0.004F},
      {0.093F, 0.030F, 0.026F, -0.004F}, {0.096F, 0.004F, 0.004F, -0.004F}};
  add_loft(mesh, T, smooth_rings(shell, 0.04F), materials.hat, 14);
  add_ellipsoid(mesh, T * at(0.095F, 0, 0.0F), {0.060F, 0.078F, 0.006F}, materials.hat, 10);
  add_ellipsoid(mesh, T * at(-0.002F, 0, 0.02F), {0.106F, 0.014F, 0.083F}, materials.hat, 10);
}

void add_cap(Mesh& mesh, const HeadMaterials& materials) {
  const Eigen::Isometry3f T =
      at(-0.004F, 0, kChin + 0.153F) * turned(-0.10F, Eigen::Vector3f::UnitY());
  const std::vector<Ring> shell = {
      {-0.012F, 0.103F, 0.081F},         {0.02F, 0.104F, 0.083F},
      {0.05F, 0.092F, 0.073F, -0.003F},  {0.07F, 0.066F, 0.053F, -0.005F},
      {0.081F, 0.036F, 0.030F, -0.006F}, {0.085F, 0.004F, 0.004F, -0.006F}};
  add_loft(mesh, T, smooth_rings(shell, 0.04F), materials.hat, 14);
  const Eigen::Isometry3f visor = T * at(0.112F, 0, 0.0F) * turned(0.16F, Eigen::Vector3f::UnitY());
  add_ellipsoid(mesh, visor, {0.070F, 0.068F, 0.007F}, materials.hat, 10);
}

void scale_by(Mesh& mesh, float factor) {
  for (Vertex& vertex : mesh.vertices) {
    vertex.position *= factor;
    vertex.uv *= factor;
  }
}

}  // namespace

Mesh make_head(const PersonStyle& style, const PersonProportions& body) {
  Mesh mesh;
  const HeadMaterials materials = add_materials(mesh, style);
  add_skull(mesh, materials);
  add_face(mesh, materials);
  if (style.headwear == Headwear::kLongHair) {
    add_long_hair(mesh, materials);
  } else {
    add_hair(mesh, materials, style.headwear == Headwear::kHair ? 0.06F : -0.03F);
  }
  if (style.headwear == Headwear::kHardHat) add_hard_hat(mesh, materials);
  if (style.headwear == Headwear::kCap) add_cap(mesh, materials);
  scale_by(mesh, body.scale);
  return mesh;
}

}  // namespace mms
