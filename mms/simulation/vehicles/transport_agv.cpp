#include "mms/simulation/vehicles/agv_kinds.hpp"
#include "mms/simulation/vehicles/agv_parts.hpp"

namespace mms {
namespace {

constexpr float kDeck = 0.66F;    ///< top of the rollers [m]
constexpr float kRoller = 0.03F;  ///< their radius [m]

/// Chassis with the frame of the conveyor, bumpers, lamps, scanners and an emergency stop.
Mesh make_body(const AgvStyle& style) {
  Mesh mesh;
  const std::uint32_t paint = mesh.add(style.paint());
  const std::uint32_t dark = mesh.add(style.dark());
  const std::uint32_t trim = mesh.add(style.trim());
  add_bevelled(mesh, {-0.66F, -0.38F, 0.08F}, {0.66F, 0.38F, 0.44F}, 0.06F, paint);
  add_block(mesh, {-0.62F, -0.385F, 0.15F}, {0.62F, 0.385F, 0.19F}, trim);
  add_block(mesh, {-0.60F, -0.30F, 0.43F}, {0.60F, 0.30F, 0.56F}, dark);
  for (const float side : {-1.0F, 1.0F}) {
    add_block(mesh, {-0.68F, side * 0.38F - 0.025F, 0.54F},
              {0.68F, side * 0.38F + 0.025F, kDeck + 0.025F}, trim);
    for (const float x : {-0.55F, 0.0F, 0.55F}) {
      add_block(mesh, {x - 0.03F, side * 0.37F - 0.02F, 0.42F},
                {x + 0.03F, side * 0.37F + 0.02F, 0.55F}, dark);
    }
    const float x = side * 0.68F;
    add_hazard_plate(mesh, {x - 0.025F, -0.36F, 0.06F}, {x + 0.025F, 0.36F, 0.17F}, style);
    add_lidar(mesh, at(side * 0.60F, side * 0.33F, 0.435F), style, 0.05F, 0.09F);
    add_block(mesh, {side * 0.655F - 0.01F, -0.3F, 0.3F}, {side * 0.655F + 0.01F, -0.1F, 0.34F},
              mesh.add(style.glow({0.95F, 0.95F, 0.80F})));
  }
  add_block(mesh, {-0.22F, -0.388F, 0.24F}, {0.22F, 0.388F, 0.38F}, mesh.add(style.sticker()));
  add_lamp(mesh, at(-0.62F, -0.385F, kDeck + 0.02F), style, 0.05F);
  add_cylinder(mesh, at(0.62F, 0.385F, kDeck + 0.035F), 0.025F, 0.015F,
               mesh.add(style.glow({0.8F, 0.05F, 0.05F})), 14);
  return mesh;
}

Mesh make_roller(const AgvStyle& style) {
  Mesh mesh;
  add_cylinder(mesh, across(), kRoller, 0.36F, mesh.add(style.steel()), 14);
  Material band = style.rubber();
  add_cylinder(mesh, at(0, 0.30F, 0) * across(), 1.03F * kRoller, 0.02F, mesh.add(band), 14);
  return mesh;
}

Mesh make_load(const AgvStyle& style) {
  Mesh mesh;
  const float length = style.between(82, 0.22F, 0.36F);
  const float width = style.between(83, 0.18F, 0.30F);
  const float height = style.between(84, 0.2F, 0.45F);
  add_block(mesh, {-length, -width, 0.0F}, {length, width, height}, mesh.add(style.cardboard(1)));
  if (style.chance(85, 0.5F)) {
    add_block(mesh, {-0.8F * length, -0.7F * width, height},
              {0.4F * length, 0.8F * width, 1.6F * height}, mesh.add(style.cardboard(2)));
  }
  return mesh;
}

/// Rollers run alternately forward and backward; their angle [rad].
float roller_angle(const AgvStyle& style, double seconds) {
  return 6.0F * style.wave(80, 12.0F, seconds);
}

}  // namespace

std::unique_ptr<ArticulatedModel> make_transport_agv(std::uint64_t seed) {
  const AgvStyle style(seed);
  AgvAssembly agv;
  agv.add(make_body(style), AgvAssembly::kBody, at(0, 0, 0));
  constexpr int kRollers = 13;
  for (int i = 0; i < kRollers; ++i) {
    const float x = -0.60F + 0.1F * static_cast<float>(i);
    agv.add(make_roller(style), AgvAssembly::kBody, [style, x](const Activity& activity) {
      return at(x, 0, kDeck - kRoller) *
             Eigen::AngleAxisf(roller_angle(style, activity.seconds), Eigen::Vector3f::UnitY());
    });
  }
  // A load moves with them without slipping.
  if (style.chance(81, 0.65F)) {
    agv.add(make_load(style), AgvAssembly::kBody, [style](const Activity& activity) {
      return at(kRoller * roller_angle(style, activity.seconds), 0, kDeck + 0.001F);
    });
  }
  for (const float y : {-0.36F, 0.36F}) {
    for (const float x : {-0.42F, 0.42F}) {
      add_wheel(agv, style, x, y, 0.11F, 0.06F, style.trim());
    }
  }
  return agv.finish("transport_agv");
}

}  // namespace mms
