#include "mms/simulation/building/fittings.hpp"

#include "mms/simulation/models/mesh_shapes.hpp"

namespace mms {
namespace {

using Eigen::Vector3f;

Material two_colored(Pattern pattern, const Vector3f& color, const Vector3f& second, float scale,
                     RandomStream& random) {
  Material material = one_colored(pattern, color, scale, random.seed());
  material.second = second;
  return material;
}

Material warning_paint(RandomStream& random) {
  return two_colored(Pattern::kHazard, {0.88F, 0.70F, 0.08F}, {0.06F, 0.06F, 0.06F}, 0.15F, random);
}

Vector3f any_color(RandomStream& random) {
  return {random.between(0.1F, 0.9F), random.between(0.1F, 0.9F), random.between(0.1F, 0.9F)};
}

}  // namespace

void add_wall(Mesh& mesh, const Eigen::Isometry3f& T, float length, float height,
              const Material& material) {
  const float half = 0.5F * length;
  add_box(mesh, T * at(0.0F, -0.1F, 0.5F * height), {half, 0.1F, 0.5F * height},
          mesh.add(material));
  Material plinth = material;
  plinth.pattern = Pattern::kPlain;
  plinth.color = 0.45F * material.color;
  add_box(mesh, T * at(0.0F, 0.006F, 0.06F), {half, 0.006F, 0.06F}, mesh.add(plinth));
}

void add_gate(Mesh& mesh, const Eigen::Isometry3f& T, RandomStream& random) {
  const float tone = random.between(0.5F, 0.8F);
  const std::uint32_t slat = mesh.add(
      one_colored(Pattern::kBrushed, {tone, tone, 1.05F * tone}, 0.2F, random.seed(), 0.1F));
  for (int i = 0; i < 16; ++i) {
    const float z = 0.1F + 0.2F * static_cast<float>(i);
    add_box(mesh, T * at(0.0F, 0.015F + (i % 2 == 0 ? 0.0F : 0.012F), z), {1.6F, 0.02F, 0.1F},
            slat);
  }
  const std::uint32_t stripes = mesh.add(warning_paint(random));
  for (const float x : {-1.7F, 1.7F}) {
    add_box(mesh, T * at(x, 0.03F, 1.6F), {0.08F, 0.05F, 1.6F}, stripes);
  }
  add_box(mesh, T * at(0.0F, 0.12F, 3.4F), {1.8F, 0.14F, 0.2F}, slat);
}

void add_door(Mesh& mesh, const Eigen::Isometry3f& T, RandomStream& random) {
  const std::uint32_t leaf =
      mesh.add(one_colored(Pattern::kPlain, 0.8F * any_color(random), 0.2F, random.seed(), 0.05F));
  const std::uint32_t steel =
      mesh.add(one_colored(Pattern::kBrushed, {0.6F, 0.6F, 0.62F}, 0.1F, random.seed(), 0.3F));
  add_box(mesh, T * at(0.0F, 0.01F, 1.05F), {0.5F, 0.02F, 1.05F}, leaf);
  for (const float x : {-0.54F, 0.54F}) {
    add_box(mesh, T * at(x, 0.02F, 1.07F), {0.04F, 0.03F, 1.07F}, steel);
  }
  add_box(mesh, T * at(0.0F, 0.02F, 2.14F), {0.58F, 0.03F, 0.04F}, steel);
  add_box(mesh, T * at(0.4F, 0.05F, 1.05F), {0.06F, 0.015F, 0.012F}, steel);
}

void add_sign(Mesh& mesh, const Eigen::Isometry3f& T, RandomStream& random) {
  const Material poster = two_colored(Pattern::kPoster, any_color(random), any_color(random),
                                      random.between(0.05F, 0.16F), random);
  const Vector3f half(random.between(0.15F, 0.6F), 0.008F, random.between(0.12F, 0.45F));
  add_box(mesh, T * at(0.0F, 0.008F, random.between(1.4F, 2.3F)), half, mesh.add(poster));
}

void add_column(Mesh& mesh, const Eigen::Isometry3f& T, float height, RandomStream& random) {
  const std::uint32_t steel =
      mesh.add(one_colored(Pattern::kBrushed, {0.5F, 0.52F, 0.53F}, 0.2F, random.seed(), 0.05F));
  const std::uint32_t stripes = mesh.add(warning_paint(random));
  add_box(mesh, T * at(0.0F, 0.0F, 0.5F * height), {0.012F, 0.14F, 0.5F * height}, steel);
  for (const float y : {-0.14F, 0.14F}) {
    add_box(mesh, T * at(0.0F, y, 0.5F * height), {0.13F, 0.012F, 0.5F * height}, steel);
  }
  for (const float side : {-1.0F, 1.0F}) {
    add_box(mesh, T * at(side * 0.19F, 0.0F, 0.45F), {0.02F, 0.21F, 0.45F}, stripes);
    add_box(mesh, T * at(0.0F, side * 0.2F, 0.45F), {0.17F, 0.02F, 0.45F}, stripes);
  }
}

void add_lamp_body(Mesh& mesh, const Eigen::Isometry3f& T) {
  const std::uint32_t shade = mesh.add(one_colored(Pattern::kPlain, {0.3F, 0.3F, 0.3F}, 1.0F, 1));
  const std::uint32_t tube = mesh.add(one_colored(Pattern::kPlain, {2.2F, 2.2F, 2.1F}, 1.0F, 2));
  add_box(mesh, T * at(0.0F, 0.0F, 0.10F), {0.65F, 0.10F, 0.03F}, shade);
  add_box(mesh, T * at(0.0F, 0.0F, 0.05F), {0.6F, 0.06F, 0.02F}, tube);
}

void add_marking(Mesh& mesh, const Eigen::Isometry3f& T, float length, float width,
                 const Material& paint) {
  add_box(mesh, T * at(0.0F, 0.0F, -0.001F), {0.5F * length, 0.5F * width, 0.002F},
          mesh.add(paint));
}

void add_pipe(Mesh& mesh, const Eigen::Isometry3f& T, float length, float radius,
              RandomStream& random) {
  const float tone = random.between(0.35F, 0.75F);
  const std::uint32_t steel =
      mesh.add(one_colored(Pattern::kBrushed, {tone, tone, tone}, 0.3F, random.seed(), 0.1F));
  const Eigen::Isometry3f along = T * Eigen::AngleAxisf(1.5707963F, Vector3f::UnitY());
  add_cylinder(mesh, along, radius, 0.5F * length, steel, 12);
}

}  // namespace mms
