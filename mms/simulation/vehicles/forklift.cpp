#include <vector>

#include "mms/simulation/vehicles/agv_kinds.hpp"
#include "mms/simulation/vehicles/agv_parts.hpp"

namespace mms {
namespace {

constexpr float kMast = 0.42F;     ///< x of the mast in the frame of the body [m]
constexpr float kCenter = -0.23F;  ///< x of that frame in the object frame [m]

/// Body with counterweight; half of them have a seat below an overhead guard.
Mesh make_body(const AgvStyle& style, bool guard, float top) {
  Mesh mesh;
  const std::uint32_t paint = mesh.add(style.paint());
  const std::uint32_t dark = mesh.add(style.dark());
  const std::vector<Eigen::Vector2f> weight = {{-0.94F, 0.28F}, {-0.84F, 0.14F}, {-0.15F, 0.14F},
                                               {-0.15F, 0.86F}, {-0.80F, 0.90F}, {-0.92F, 0.78F}};
  add_prism(mesh, at(0, 0, 0), weight, 0.50F, paint);
  const std::vector<Eigen::Vector2f> step = {
      {-0.16F, 0.14F}, {0.30F, 0.14F}, {0.36F, 0.22F}, {0.36F, 0.40F}, {-0.16F, 0.40F}};
  add_prism(mesh, at(0, 0, 0), step, 0.42F, dark);
  add_block(mesh, {0.16F, -0.42F, 0.40F}, {0.34F, 0.42F, guard ? 0.86F : 1.10F}, paint);
  add_hazard_plate(mesh, {-0.955F, -0.44F, 0.34F}, {-0.89F, 0.44F, 0.50F}, style);
  add_block(mesh, {-0.70F, -0.505F, 0.50F}, {-0.35F, 0.505F, 0.72F}, mesh.add(style.sticker()));
  if (!guard) {
    add_block(mesh, {-0.80F, -0.44F, 0.86F}, {0.20F, 0.44F, 1.16F}, paint);
    add_block(mesh, {-0.78F, -0.40F, 1.16F}, {0.12F, 0.40F, 1.19F}, dark);
    add_bar(mesh, {-0.55F, 0, 1.1F}, {-0.55F, 0, top - 0.30F}, 0.04F, dark);
    add_lidar(mesh, at(-0.55F, 0, top - 0.31F), style, 0.09F, 0.18F);
    add_lamp(mesh, at(-0.2F, 0.28F, 1.18F), style, 0.09F);
  }
  return mesh;
}

/// Four posts, a roof of bars, seat, steering wheel, beacon and scanner.
Mesh make_guard(const AgvStyle& style, float top) {
  Mesh mesh;
  const std::uint32_t dark = mesh.add(style.dark());
  for (const float y : {-0.44F, 0.44F}) {
    add_bar(mesh, {0.27F, y, 0.40F}, {0.12F, 0.95F * y, top}, 0.030F, dark);
    add_bar(mesh, {-0.77F, y, 0.85F}, {-0.70F, 0.95F * y, top}, 0.034F, dark);
    add_bar(mesh, {0.12F, 0.95F * y, top}, {-0.70F, 0.95F * y, top}, 0.030F, dark);
  }
  for (int i = 0; i <= 7; ++i) {
    const float x = -0.70F + 0.117F * static_cast<float>(i);
    add_bar(mesh, {x, -0.42F, top}, {x, 0.42F, top}, 0.018F, dark, 8);
  }
  add_block(mesh, {-0.62F, -0.25F, 0.86F}, {-0.18F, 0.25F, 0.98F}, dark);
  const std::vector<Eigen::Vector2f> back = {
      {-0.62F, 0.95F}, {-0.50F, 0.95F}, {-0.58F, 1.42F}, {-0.68F, 1.42F}};
  add_prism(mesh, at(0, 0, 0), back, 0.23F, dark);
  add_bar(mesh, {0.18F, 0, 0.8F}, {0.04F, 0, 1.04F}, 0.025F, dark);
  Eigen::Isometry3f T = at(0.04F, 0, 1.05F);
  T.rotate(Eigen::AngleAxisf(-0.55F, Eigen::Vector3f::UnitY()));
  add_cylinder(mesh, T, 0.17F, 0.015F, dark, 20);
  add_lamp(mesh, at(-0.55F, -0.3F, top + 0.01F), style, 0.08F);
  add_lidar(mesh, at(-0.1F, 0, top + 0.01F), style, 0.07F, 0.11F);
  return mesh;
}

/// Two upright rails with cross members, from `low` to `high`; `half` apart.
Mesh make_rails(const AgvStyle& style, float low, float high, float half, bool chain) {
  Mesh mesh;
  const std::uint32_t dark = mesh.add(style.dark());
  const std::uint32_t steel = mesh.add(style.steel());
  for (const float side : {-1.0F, 1.0F}) {
    add_block(mesh, {-0.05F, side * half - 0.035F, low}, {0.05F, side * half + 0.035F, high}, dark);
    if (chain) add_bar(mesh, {0.0F, side * 0.12F, low}, {0.0F, side * 0.12F, high}, 0.022F, steel);
  }
  add_block(mesh, {-0.04F, -half, high - 0.09F}, {0.04F, half, high - 0.01F}, dark);
  add_block(mesh, {-0.04F, -half, low}, {0.04F, half, low + 0.08F}, dark);
  return mesh;
}

/// Carriage with a load guard and two forks; its origin is at the upper face of the forks.
Mesh make_carriage(const AgvStyle& style) {
  Mesh mesh;
  const std::uint32_t dark = mesh.add(style.dark());
  const std::uint32_t steel = mesh.add(style.steel());
  for (const float z : {0.02F, 0.34F}) {
    add_block(mesh, {0.04F, -0.46F, z}, {0.09F, 0.46F, z + 0.08F}, dark);
  }
  for (int i = -3; i <= 3; ++i) {
    const float y = 0.145F * static_cast<float>(i);
    add_block(mesh, {0.05F, y - 0.012F, 0.40F}, {0.08F, y + 0.012F, 0.92F}, dark);
  }
  add_block(mesh, {0.05F, -0.46F, 0.90F}, {0.08F, 0.46F, 0.93F}, dark);
  const std::vector<Eigen::Vector2f> blade = {
      {0.09F, -0.045F}, {0.55F, -0.045F}, {0.98F, -0.015F}, {0.98F, 0.0F}, {0.10F, 0.0F}};
  for (const float y : {-0.26F, 0.26F}) {
    add_prism(mesh, at(0, y, 0), blade, 0.06F, steel);
    add_block(mesh, {0.09F, y - 0.06F, -0.045F}, {0.13F, y + 0.06F, 0.42F}, steel);
  }
  return mesh;
}

void add_pallet(Mesh& mesh, const AgvStyle& style) {
  const std::uint32_t wood = mesh.add(style.wood());
  for (int i = 0; i < 5; ++i) {
    const float y = -0.40F + 0.2F * static_cast<float>(i);
    add_block(mesh, {0.14F, y - 0.07F, 0.10F}, {1.06F, y + 0.07F, 0.125F}, wood);
  }
  for (const float y : {-0.43F, 0.0F, 0.43F}) {
    add_block(mesh, {0.14F, y - 0.045F, 0.0F}, {1.06F, y + 0.045F, 0.10F}, wood);
  }
}

/// A pallet with cartons in one or two layers, on the forks.
Mesh make_load(const AgvStyle& style) {
  Mesh mesh;
  add_pallet(mesh, style);
  const int layers = style.chance(31, 0.5F) ? 2 : 1;
  std::uint32_t number = 0;
  for (int layer = 0; layer < layers; ++layer) {
    const float low = 0.126F + 0.33F * static_cast<float>(layer);
    for (const float x : {0.15F, 0.61F}) {
      for (const float y : {-0.46F, 0.01F}) {
        const float high =
            low + (layer + 1 == layers ? style.between(40 + number, 0.2F, 0.32F) : 0.33F);
        add_block(mesh, {x, y, low}, {x + 0.45F, y + 0.45F, high},
                  mesh.add(style.cardboard(number)));
        ++number;
      }
    }
  }
  return mesh;
}

}  // namespace

std::unique_ptr<ArticulatedModel> make_forklift(std::uint64_t seed) {
  const AgvStyle style(seed);
  AgvAssembly agv;
  const bool guard = style.chance(30, 0.55F);
  const float top = style.between(32, 1.95F, 2.05F);
  const std::size_t body =
      agv.add(make_body(style, guard, top), AgvAssembly::kBody, at(kCenter, 0, 0));
  if (guard) agv.add(make_guard(style, top), body, at(0, 0, 0));
  for (const float y : {-0.46F, 0.46F}) {
    add_wheel(agv, style, 0.16F + kCenter, y, 0.24F, 0.16F, style.trim());
    add_wheel(agv, style, -0.66F + kCenter, 0.96F * y, 0.19F, 0.15F, style.trim());
  }
  // The inner mast rises half as far as the forks.
  const auto lift = [style](const Activity& activity) {
    return 0.24F * (1.0F + style.wave(33, 16.0F, activity.seconds));
  };
  agv.add(make_rails(style, 0.08F, top - 0.05F, 0.36F, true), body, at(kMast, 0, 0));
  agv.add(make_rails(style, 0.10F, top - 0.03F, 0.28F, false), body,
          [lift](const Activity& a) { return at(kMast + 0.01F, 0, 0.5F * lift(a)); });
  const std::size_t carriage = agv.add(make_carriage(style), body, [lift](const Activity& a) {
    return at(kMast + 0.02F, 0, 0.08F + lift(a));
  });
  if (style.chance(34, 0.6F)) agv.add(make_load(style), carriage, at(0, 0, 0.001F));
  return agv.finish("forklift");
}

}  // namespace mms
