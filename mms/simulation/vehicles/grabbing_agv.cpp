#include <array>
#include <vector>

#include "mms/simulation/vehicles/agv_kinds.hpp"
#include "mms/simulation/vehicles/agv_parts.hpp"

namespace mms {
namespace {

/// Low platform with bumpers, scanners, a control cabinet and a bin for picked goods.
Mesh make_base(const AgvStyle& style) {
  Mesh mesh;
  const std::uint32_t paint = mesh.add(style.paint());
  const std::uint32_t dark = mesh.add(style.dark());
  const std::uint32_t trim = mesh.add(style.trim());
  add_bevelled(mesh, {-0.58F, -0.38F, 0.09F}, {0.58F, 0.38F, 0.46F}, 0.05F, paint);
  add_block(mesh, {-0.55F, -0.385F, 0.16F}, {0.55F, 0.385F, 0.20F}, dark);
  add_block(mesh, {-0.56F, -0.36F, 0.458F}, {0.56F, 0.36F, 0.475F}, dark);
  for (const float side : {-1.0F, 1.0F}) {
    const float x = side * 0.60F;
    add_hazard_plate(mesh, {x - 0.03F, -0.36F, 0.07F}, {x + 0.03F, 0.36F, 0.17F}, style);
    add_lidar(mesh, at(side * 0.52F, side * 0.30F, 0.47F), style, 0.055F, 0.11F);
  }
  add_block(mesh, {-0.25F, -0.388F, 0.25F}, {0.10F, 0.388F, 0.38F}, mesh.add(style.sticker()));
  // The bin: four thin walls around cartons.
  const std::array<std::array<float, 4>, 4> walls = {{{-0.52F, -0.08F, -0.32F, -0.30F},
                                                      {-0.52F, -0.08F, 0.30F, 0.32F},
                                                      {-0.52F, -0.50F, -0.32F, 0.32F},
                                                      {-0.10F, -0.08F, -0.32F, 0.32F}}};
  for (const std::array<float, 4>& w : walls) {
    add_block(mesh, {w[0], w[2], 0.47F}, {w[1], w[3], 0.70F}, trim);
  }
  add_block(mesh, {-0.48F, -0.26F, 0.47F}, {-0.15F, 0.02F, 0.74F}, mesh.add(style.cardboard(1)));
  add_block(mesh, {-0.42F, 0.05F, 0.47F}, {-0.18F, 0.27F, 0.66F}, mesh.add(style.cardboard(2)));
  add_bar(mesh, {0.5F, -0.28F, 0.46F}, {0.5F, -0.28F, 0.82F}, 0.018F, dark);
  add_lamp(mesh, at(0.5F, -0.28F, 0.81F), style, 0.055F);
  return mesh;
}

/// Thick transverse joint with a link of `length` [m] upwards.
Mesh make_link(const AgvStyle& style, float length, float radius, bool bright) {
  Mesh mesh;
  const std::uint32_t paint = mesh.add(bright ? style.trim() : style.paint());
  const std::uint32_t dark = mesh.add(style.dark());
  const std::array<Ring, 4> rings = {{{0.0F, radius, 0.9F * radius},
                                      {0.25F * length, 0.85F * radius, 0.8F * radius},
                                      {0.75F * length, 0.7F * radius, 0.68F * radius},
                                      {length, 0.72F * radius, 0.7F * radius}}};
  add_loft(mesh, at(0, 0, 0), rings, paint, 18);
  add_cylinder(mesh, across(), 1.12F * radius, 1.25F * radius, paint, 22);
  add_cylinder(mesh, across(), 0.8F * radius, 1.40F * radius, dark, 18);
  return mesh;
}

Mesh make_turntable(const AgvStyle& style) {
  Mesh mesh;
  const std::uint32_t dark = mesh.add(style.dark());
  const std::array<Ring, 4> rings = {
      {{0.0F, 0.15F, 0.15F}, {0.06F, 0.15F, 0.15F}, {0.10F, 0.11F, 0.11F}, {0.20F, 0.10F, 0.10F}}};
  add_loft(mesh, at(0, 0, 0), rings, dark, 24);
  add_cylinder(mesh, at(0, 0, 0.03F), 0.155F, 0.012F, mesh.add(style.hazard()), 24);
  return mesh;
}

/// Palm with a camera.
Mesh make_palm(const AgvStyle& style) {
  Mesh mesh;
  const std::uint32_t dark = mesh.add(style.dark());
  add_cylinder(mesh, at(0, 0, 0.035F), 0.045F, 0.035F, mesh.add(style.steel()), 16);
  add_block(mesh, {-0.04F, -0.08F, 0.07F}, {0.04F, 0.08F, 0.12F}, dark);
  add_block(mesh, {0.04F, -0.035F, 0.05F}, {0.075F, 0.035F, 0.09F}, dark);
  return mesh;
}

Mesh make_finger(const AgvStyle& style) {
  Mesh mesh;
  add_block(mesh, {-0.025F, -0.012F, 0.0F}, {0.025F, 0.012F, 0.13F}, mesh.add(style.steel()));
  return mesh;
}

/// Turntable, three links, wrist and two fingers on the platform.
void add_arm(AgvAssembly& agv, const AgvStyle& style) {
  const Eigen::Vector3f y = Eigen::Vector3f::UnitY();
  const Eigen::Vector3f z = Eigen::Vector3f::UnitZ();
  const auto turn = [&](std::uint64_t what, float period, const Eigen::Vector3f& axis, float center,
                        float amplitude, float height) {
    return style.swing(what, period, axis, center, amplitude, at(0, 0, height));
  };
  const std::size_t table =
      agv.add(make_turntable(style), AgvAssembly::kBody,
              style.swing(50, 13.0F, z, 0.0F, 0.9F, at(0.24F, 0.02F, 0.474F)));
  const std::size_t shoulder =
      agv.add(make_link(style, 0.46F, 0.085F, true), table, turn(51, 9.0F, y, 0.05F, 0.25F, 0.24F));
  const std::size_t elbow = agv.add(make_link(style, 0.40F, 0.07F, true), shoulder,
                                    turn(52, 7.0F, y, 1.35F, 0.35F, 0.46F));
  const std::size_t wrist =
      agv.add(make_link(style, 0.12F, 0.052F, false), elbow, turn(53, 6.0F, y, 0.9F, 0.35F, 0.40F));
  const std::size_t palm = agv.add(make_palm(style), wrist, turn(54, 8.0F, z, 0.0F, 0.8F, 0.12F));
  for (const float side : {-1.0F, 1.0F}) {
    agv.add(make_finger(style), palm, [style, side](const Activity& activity) {
      const float open = 0.042F + 0.02F * style.wave(55, 5.0F, activity.seconds);
      return at(0, side * open, 0.118F);
    });
  }
}

}  // namespace

std::unique_ptr<ArticulatedModel> make_grabbing_agv(std::uint64_t seed) {
  const AgvStyle style(seed);
  AgvAssembly agv;
  agv.add(make_base(style), AgvAssembly::kBody, at(0, 0, 0));
  for (const float y : {-0.36F, 0.36F}) {
    for (const float x : {-0.36F, 0.36F}) {
      add_wheel(agv, style, x, y, 0.11F, 0.07F, style.steel());
    }
  }
  add_arm(agv, style);
  return agv.finish("grabbing_agv");
}

}  // namespace mms
