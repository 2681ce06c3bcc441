#include "mms/simulation/building/building.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "mms/core/random_stream.hpp"
#include "mms/simulation/building/fittings.hpp"
#include "mms/simulation/building/stock.hpp"
#include "mms/simulation/models/mesh_shapes.hpp"

namespace mms {
namespace {

using Eigen::Vector3f;

constexpr float kPi = std::numbers::pi_v<float>;

Eigen::Isometry3f turned(float x, float y, float z, float yaw) {
  return at(x, y, z) * Eigen::AngleAxisf(yaw, Vector3f::UnitZ());
}

/// Walls of a rectangular room centered at the origin.
struct Side {
  Eigen::Isometry3f T;  ///< base of the wall's center, x along it, y into the room
  float length = 0.0F;
};

std::array<Side, 4> sides_of(float half_x, float half_y) {
  return {{{turned(0.0F, -half_y, 0.0F, 0.0F), 2.0F * half_x},
           {turned(half_x, 0.0F, 0.0F, 0.5F * kPi), 2.0F * half_y},
           {turned(0.0F, half_y, 0.0F, kPi), 2.0F * half_x},
           {turned(-half_x, 0.0F, 0.0F, -0.5F * kPi), 2.0F * half_y}}};
}

/// Floor, ceiling and four walls.
void add_shell(Mesh& mesh, float half_x, float half_y, float height, const Material& wall,
               RandomStream& random) {
  const Material floor =
      one_colored(Pattern::kConcrete, {0.56F, 0.57F, 0.57F}, 1.0F, random.seed(), 0.03F);
  const Material roof = one_colored(Pattern::kBrushed, {0.6F, 0.62F, 0.64F}, 1.0F, random.seed());
  add_box(mesh, at(0.0F, 0.0F, -0.1F), {half_x + 0.3F, half_y + 0.3F, 0.1F}, mesh.add(floor));
  add_box(mesh, at(0.0F, 0.0F, height + 0.1F), {half_x + 0.3F, half_y + 0.3F, 0.1F},
          mesh.add(roof));
  for (const Side& side : sides_of(half_x, half_y)) {
    Material own = wall;
    own.seed = random.seed();
    add_wall(mesh, side.T, side.length, height, own);
  }
}

/// Rows of lamps at `height` over a floor of the given half size.
void add_lamps(Building& building, float half_x, float half_y, float height, float spacing,
               RandomStream& random) {
  const int nx = std::max(1, static_cast<int>(std::lround(2.0F * half_x / spacing)));
  const int ny = std::max(1, static_cast<int>(std::lround(2.0F * half_y / spacing)));
  for (int i = 0; i < nx; ++i) {
    for (int j = 0; j < ny; ++j) {
      const float x =
          ((static_cast<float>(i) + 0.5F) * 2.0F / static_cast<float>(nx) - 1.0F) * half_x;
      const float y =
          ((static_cast<float>(j) + 0.5F) * 2.0F / static_cast<float>(ny) - 1.0F) * half_y;
      add_lamp_body(building.mesh, at(x, y, height));
      const float strength = random.between(0.75F, 1.1F) * height * height / 9.0F * 0.75F;
      const Vector3f tint(1.0F, random.between(0.94F, 1.0F), random.between(0.84F, 1.0F));
      building.lights.lamps.push_back({{x, y, height}, strength * tint});
    }
  }
}

/// Signs, doors, gates and pipes along a wall.
void furnish_wall(Mesh& mesh, const Side& side, float clutter, bool gates, RandomStream& random) {
  const auto slots = static_cast<int>(side.length / 2.6F);
  for (int i = 0; i < slots; ++i) {
    const float x = (static_cast<float>(i) + 0.5F) * side.length / static_cast<float>(slots) -
                    0.5F * side.length;
    const Eigen::Isometry3f T = side.T * at(x, 0.0F, 0.0F);
    const float what = random.uniform();
    if (gates && what < 0.18F && i > 0 && i + 1 < slots) {
      add_gate(mesh, T, random);
    } else if (what < 0.30F) {
      add_door(mesh, T, random);
    } else if (random.chance(0.75F * clutter)) {
      add_sign(mesh, T * at(random.between(-0.6F, 0.6F), 0.0F, 0.0F), random);
    }
  }
  if (clutter > 0.0F) add_pipe(mesh, side.T * at(0.0F, 0.15F, 3.6F), side.length, 0.06F, random);
}

/// Floor markings on both sides of a straight part of the lane.
void mark_lane(Mesh& mesh, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
               double half_width, const Material& paint) {
  const Eigen::Vector2d center = 0.5 * (from + to);
  const Eigen::Vector2d along = to - from;
  const auto yaw = static_cast<float>(std::atan2(along.y(), along.x()));
  const Eigen::Isometry3f T =
      turned(static_cast<float>(center.x()), static_cast<float>(center.y()), 0.0F, yaw);
  const auto length = static_cast<float>(along.norm() - 2.0 * half_width);
  for (const float side : {-1.0F, 1.0F}) {
    add_marking(mesh, T * at(0.0F, side * static_cast<float>(half_width), 0.0F), length, 0.1F,
                paint);
  }
}

/// Pallets, stacks of cartons and columns along the outer walls of the hall.
void clutter_along(Mesh& mesh, const Side& side, float clutter, RandomStream& random) {
  for (float x = -0.5F * side.length + 1.2F; x < 0.5F * side.length - 1.2F; x += 1.9F) {
    if (!random.chance(0.55F * clutter)) continue;
    const Eigen::Isometry3f T =
        side.T * turned(x + random.between(-0.2F, 0.2F), random.between(0.5F, 0.62F), 0.0F,
                        random.between(-0.15F, 0.15F));
    if (random.chance(0.7F)) {
      add_loaded_pallet(mesh, T, random.between(0.5F, 1.9F), random);
    } else {
      for (int i = 0; i < 3; ++i)
        add_pallet(mesh, T * at(0.0F, 0.0F, 0.14F * static_cast<float>(i)), random);
    }
  }
}

void add_workplaces(Building& building, double x_from, double x_to, double y, double yaw) {
  for (double x = x_from; x <= x_to; x += kBayLength) {
    building.workplaces.push_back({{x, y}, yaw});
  }
}

/// 26 x 18 m with two double rows of racks in the center and a lane of about 60 m around them.
Building build_hall(const SceneConfig& config, RandomStream& random) {
  constexpr float kHalfX = 13.0F;
  constexpr float kHalfY = 9.0F;
  constexpr float kHeight = 7.0F;
  const auto clutter = static_cast<float>(config.clutter);
  Building hall;
  const Material wall = one_colored(Pattern::kPlaster, {0.74F, 0.75F, 0.72F}, 0.35F, 1);
  add_shell(hall.mesh, kHalfX, kHalfY, kHeight, wall, random);
  RandomStream today(daily_seed(config, 0x60d5));
  const std::span<RandomStream> changes(&today, config.day > 0 ? 1 : 0);
  for (const float y : {-2.75F, -1.65F, 1.65F, 2.75F}) {
    add_rack(hall.mesh, at(0.0F, y, 0.0F), 5, 3, false, random, changes);
  }
  for (const Side& side : sides_of(kHalfX, kHalfY)) {
    furnish_wall(hall.mesh, side, clutter, true, random);
    clutter_along(hall.mesh, side, clutter, random);
  }
  for (const float x : {-7.6F, 7.6F}) {
    for (const float y : {-2.2F, 2.2F}) add_column(hall.mesh, at(x, y, 0.0F), kHeight, random);
  }
  add_lamps(hall, kHalfX, kHalfY, 6.2F, 6.0F, random);
  hall.lane = {{-9.9, -5.6}, {9.9, -5.6}, {9.9, 5.6}, {-9.9, 5.6}};
  hall.lane_closed = true;
  hall.lane_half_width = 1.9;
  const Material paint = one_colored(Pattern::kPlain, {0.85F, 0.72F, 0.12F}, 0.03F, random.seed());
  for (std::size_t i = 0; i < hall.lane.size(); ++i) {
    mark_lane(hall.mesh, hall.lane[i], hall.lane[(i + 1) % hall.lane.size()], hall.lane_half_width,
              paint);
  }
  add_workplaces(hall, -5.4, 5.4, 3.3 + 0.55, -0.5 * std::numbers::pi);
  add_workplaces(hall, -5.4, 5.4, -3.3 - 0.55, 0.5 * std::numbers::pi);
  return hall;
}

/// 34 x 2.6 m with plain walls and a few doors.
Building build_corridor(const SceneConfig& config, RandomStream& random) {
  constexpr float kHalfX = 17.0F;
  constexpr float kHalfY = 1.3F;
  constexpr float kHeight = 2.8F;
  Building corridor;
  const Material wall = one_colored(Pattern::kPlaster, {0.78F, 0.77F, 0.72F}, 0.5F, 1);
  add_shell(corridor.mesh, kHalfX, kHalfY, kHeight, wall, random);
  for (const Side& side : sides_of(kHalfX, kHalfY)) {
    furnish_wall(corridor.mesh, side, 0.35F * static_cast<float>(config.clutter), false, random);
  }
  add_lamps(corridor, kHalfX, 0.5F * kHalfY, 2.65F, 4.0F, random);
  corridor.lane = {{-15.5, 0.0}, {15.5, 0.0}};
  corridor.lane_half_width = 0.7;
  return corridor;
}

/// An aisle of 3 m between two racks of 27 m with identical bays.
Building build_aisle(const SceneConfig& config, RandomStream& random) {
  constexpr float kHalfX = 17.0F;
  constexpr float kHalfY = 6.0F;
  constexpr float kHeight = 6.5F;
  Building aisle;
  const Material wall = one_colored(Pattern::kPlaster, {0.74F, 0.75F, 0.72F}, 0.35F, 1);
  add_shell(aisle.mesh, kHalfX, kHalfY, kHeight, wall, random);
  add_rack(aisle.mesh, turned(0.0F, 2.05F, 0.0F, 0.0F), 10, 3, true, random);
  add_rack(aisle.mesh, turned(0.0F, -2.05F, 0.0F, kPi), 10, 3, true, random);
  for (const Side& side : sides_of(kHalfX, kHalfY)) {
    furnish_wall(aisle.mesh, side, static_cast<float>(config.clutter), true, random);
  }
  add_lamps(aisle, kHalfX, kHalfY, 5.8F, 6.0F, random);
  aisle.lane = {{-15.0, 0.0}, {15.0, 0.0}};
  aisle.lane_half_width = 1.2;
  const Material paint = one_colored(Pattern::kPlain, {0.85F, 0.72F, 0.12F}, 0.03F, random.seed());
  mark_lane(aisle.mesh, aisle.lane[0], aisle.lane[1], 1.35, paint);
  add_workplaces(aisle, -9.45, 9.45, 1.5 - 0.5, 0.5 * std::numbers::pi);
  return aisle;
}

/// 38 x 28 m with four aisles of 27 m, equal but for a fifth of the loads of each. The second one
/// is mirrored, the fourth turned by half a turn.
Building build_aisles(const SceneConfig& config, RandomStream& random) {
  constexpr float kHalfX = 19.0F;
  constexpr float kHalfY = 14.0F;
  constexpr float kHeight = 6.5F;
  constexpr float kPitch = 6.8F;
  constexpr double kEnd = 15.9;
  Building aisles;
  const Material wall = one_colored(Pattern::kPlaster, {0.74F, 0.75F, 0.72F}, 0.35F, 1);
  add_shell(aisles.mesh, kHalfX, kHalfY, kHeight, wall, random);
  const Material paint = one_colored(Pattern::kPlain, {0.85F, 0.72F, 0.12F}, 0.03F, random.seed());
  const RandomStream equal(random.bits());
  const auto y_of = [](int aisle) { return kPitch * (static_cast<float>(aisle) - 1.5F); };
  aisles.lane_half_width = 1.9;
  aisles.vehicle_aside = 1.6;
  aisles.care = 12.0;
  for (int i = 0; i < 4; ++i) {
    RandomStream loads = equal;
    std::array<RandomStream, 2> changes = {
        RandomStream(random.bits()),
        RandomStream(daily_seed(config, 0x60d5 + static_cast<std::uint64_t>(i)))};
    Mesh racks;
    for (const float yaw : {0.0F, kPi}) {
      add_rack(racks, turned(0.0F, 0.0F, 0.0F, yaw) * at(0.0F, 2.85F, 0.0F), 10, 3, false, loads,
               std::span(changes).first(config.day > 0 ? 2 : 1));
    }
    if (i == 1) mirror(racks);
    append(aisles.mesh, racks, turned(0.0F, y_of(i), 0.0F, i == 3 ? kPi : 0.0F));
    const double y = y_of(i);
    mark_lane(aisles.mesh, {-kEnd, y}, {kEnd, y}, aisles.lane_half_width, paint);
    add_workplaces(aisles, -12.15, 12.15, y + 1.75, 0.5 * std::numbers::pi);
    add_workplaces(aisles, -12.15, 12.15, y - 1.75, -0.5 * std::numbers::pi);
  }
  for (const Side& side : sides_of(kHalfX, kHalfY)) {
    furnish_wall(aisles.mesh, side, static_cast<float>(config.clutter), true, random);
  }
  for (const std::size_t end : {1U, 3U}) {
    clutter_along(aisles.mesh, sides_of(kHalfX, kHalfY)[end], static_cast<float>(config.clutter),
                  random);
  }
  add_lamps(aisles, kHalfX, kHalfY, 5.8F, kPitch, random);
  // Each aisle twice, two of them in the other direction the second time.
  double end = kEnd;
  for (const int aisle : {0, 1, 2, 3, 0, 2, 3, 1}) {
    aisles.lane.emplace_back(-end, y_of(aisle));
    aisles.lane.emplace_back(end, y_of(aisle));
    end = -end;
  }
  aisles.lane_closed = true;
  return aisles;
}

}  // namespace

Building build(const SceneConfig& config) {
  RandomStream random(hash_of(static_cast<std::uint64_t>(config.seed), 0xb01d));
  switch (config.layout) {
    case Layout::kCorridor:
      return build_corridor(config, random);
    case Layout::kAisle:
      return build_aisle(config, random);
    case Layout::kAisles:
      return build_aisles(config, random);
    case Layout::kHall:
      break;
  }
  return build_hall(config, random);
}

}  // namespace mms
