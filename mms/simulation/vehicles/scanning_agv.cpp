#include <array>
#include <cmath>
#include <numbers>

#include "mms/simulation/vehicles/agv_kinds.hpp"
#include "mms/simulation/vehicles/agv_parts.hpp"

namespace mms {
namespace {

Mesh make_base(const AgvStyle& style) {
  Mesh mesh;
  const std::uint32_t dark = mesh.add(style.dark());
  add_bevelled(mesh, {-0.33F, -0.27F, 0.07F}, {0.33F, 0.27F, 0.38F}, 0.06F,
               mesh.add(style.paint()));
  add_block(mesh, {-0.31F, -0.275F, 0.13F}, {0.31F, 0.275F, 0.16F}, mesh.add(style.trim()));
  for (const float side : {-1.0F, 1.0F}) {
    const float x = side * 0.335F;
    add_block(mesh, {x - 0.015F, -0.25F, 0.07F}, {x + 0.015F, 0.25F, 0.14F}, dark);
  }
  add_block(mesh, {0.325F, -0.16F, 0.19F}, {0.338F, 0.16F, 0.29F}, mesh.add(style.sticker()));
  add_hazard_plate(mesh, {-0.338F, -0.2F, 0.2F}, {-0.325F, 0.2F, 0.28F}, style);
  add_lidar(mesh, at(0.22F, 0, 0.375F), style, 0.06F, 0.11F);
  add_lamp(mesh, at(-0.24F, 0.18F, 0.375F), style, 0.05F);
  return mesh;
}

/// Column with a screen behind and bar-code cameras on both sides.
Mesh make_column(const AgvStyle& style, float height) {
  Mesh mesh;
  const std::uint32_t dark = mesh.add(style.dark());
  const std::uint32_t lens = mesh.add(style.glow({0.10F, 0.16F, 0.30F}));
  const std::array<Ring, 4> rings = {{{0.37F, 0.13F, 0.15F, -0.06F},
                                      {0.46F, 0.085F, 0.10F, -0.06F},
                                      {0.7F * height, 0.07F, 0.085F, -0.06F},
                                      {height, 0.06F, 0.07F, -0.06F}}};
  add_loft(mesh, at(0, 0, 0), rings, mesh.add(style.paint()), 24);
  const int cameras = 3;
  for (int i = 0; i < cameras; ++i) {
    const float z = 0.62F + 0.22F * static_cast<float>(i) * (height - 0.5F);
    add_block(mesh, {-0.10F, -0.14F, z}, {-0.02F, 0.14F, z + 0.08F}, dark);
    for (const float side : {-1.0F, 1.0F}) {
      add_cylinder(mesh, at(-0.06F, side * 0.142F, z + 0.04F) * across(), 0.028F, 0.006F, lens, 14);
    }
  }
  Eigen::Isometry3f T = at(-0.19F, 0, 0.78F * height);
  T.rotate(Eigen::AngleAxisf(-0.3F, Eigen::Vector3f::UnitY()));
  add_box(mesh, T, {0.012F, 0.14F, 0.09F}, dark);
  add_box(mesh, T * at(-0.012F, 0, 0), {0.002F, 0.13F, 0.08F}, lens);
  add_bar(mesh, {-0.06F, 0, 0.76F * height}, {-0.19F, 0, 0.78F * height}, 0.02F, dark);
  return mesh;
}

/// Rotating head: a wide box with two lenses.
Mesh make_head(const AgvStyle& style) {
  Mesh mesh;
  const std::uint32_t dark = mesh.add(style.dark());
  const std::uint32_t lens = mesh.add(style.glow({0.08F, 0.20F, 0.42F}));
  add_cylinder(mesh, at(0, 0, 0.02F), 0.05F, 0.03F, dark, 16);
  add_bevelled(mesh, {-0.08F, -0.15F, 0.04F}, {0.10F, 0.15F, 0.17F}, 0.025F,
               mesh.add(style.trim()));
  add_block(mesh, {0.095F, -0.12F, 0.06F}, {0.106F, 0.12F, 0.15F}, dark);
  for (const float y : {-0.07F, 0.07F}) {
    Eigen::Isometry3f T = at(0.108F, y, 0.105F);
    T.rotate(Eigen::AngleAxisf(0.5F * std::numbers::pi_v<float>, Eigen::Vector3f::UnitY()));
    add_cylinder(mesh, T, 0.033F, 0.012F, lens, 16);
  }
  return mesh;
}

/// Spinning lidar: a drum with two windows.
Mesh make_drum(const AgvStyle& style) {
  Mesh mesh;
  const std::uint32_t steel = mesh.add(style.steel());
  const std::uint32_t window = mesh.add(style.glow({0.05F, 0.05F, 0.08F}));
  add_cylinder(mesh, at(0, 0, 0.045F), 0.055F, 0.045F, steel, 22);
  for (const float side : {-1.0F, 1.0F}) {
    add_block(mesh, {side * 0.05F - 0.008F, -0.028F, 0.015F},
              {side * 0.05F + 0.008F, 0.028F, 0.075F}, window);
  }
  return mesh;
}

Eigen::Isometry3f spin(double seconds, double period, float z) {
  const double turns = seconds / period;
  const auto share = static_cast<float>(turns - std::floor(turns));
  Eigen::Isometry3f T = at(0, 0, z);
  T.rotate(Eigen::AngleAxisf(2.0F * std::numbers::pi_v<float> * share, Eigen::Vector3f::UnitZ()));
  return T;
}

}  // namespace

std::unique_ptr<ArticulatedModel> make_scanning_agv(std::uint64_t seed) {
  const AgvStyle style(seed);
  AgvAssembly agv;
  const float height = style.between(61, 1.26F, 1.42F);
  const std::size_t base = agv.add(make_base(style), AgvAssembly::kBody, at(0, 0, 0));
  agv.add(make_column(style, height), base, at(0, 0, 0));
  const std::size_t head =
      agv.add(make_head(style), base,
              style.swing(60, 8.0F, Eigen::Vector3f::UnitZ(), 0.0F, 1.3F, at(-0.06F, 0, height)));
  agv.add(make_drum(style), head,
          [](const Activity& activity) { return spin(activity.seconds, 1.0, 0.169F); });
  for (const float y : {-0.26F, 0.26F}) {
    add_wheel(agv, style, 0.0F, y, 0.13F, 0.06F, style.trim());
    for (const float x : {-0.24F, 0.24F}) {
      add_wheel(agv, style, x, 0.75F * y, 0.05F, 0.03F, style.steel());
    }
  }
  return agv.finish("scanning_agv");
}

}  // namespace mms
