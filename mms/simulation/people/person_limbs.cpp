#include <cmath>
#include <vector>

#include "mms/simulation/people/person_parts.hpp"
#include "mms/simulation/people/person_shapes.hpp"

namespace mms {
namespace {

// Radii and offsets are shares of the height; lengths of hand and shoe are for 1.75 m.

/// Limb along -z: z of `keys` is a share of `length`, from -1 at the lower to 0 at the upper end.
std::vector<Ring> limb(std::vector<Ring> keys, float length, float height, float build) {
  for (Ring& key : keys) {
    key.z *= length;
    key.rx *= height * build;
    key.ry *= height * build;
    key.x *= height;
    key.y *= height;
  }
  return rounded_rings(smooth_rings(keys, 0.07F));
}

void add_hand(Mesh& mesh, float wrist, float scale, float side, std::uint32_t material) {
  const Eigen::Isometry3f T = at(0, 0, wrist);
  const std::vector<Ring> palm = {{-0.088F, 0.036F, 0.013F, 0.002F},
                                  {-0.06F, 0.041F, 0.016F, 0.001F},
                                  {-0.02F, 0.034F, 0.018F},
                                  {0.02F, 0.028F, 0.022F}};
  add_loft(mesh, T, rounded_rings(scaled_rings(palm, scale), 2), material, 9);
  for (int i = 0; i < 4; ++i) {
    const float x = -0.028F + 0.0195F * static_cast<float>(i);
    const float tip = -0.165F - (i == 1 || i == 2 ? 0.012F : 0.0F);
    const float bent = -0.022F * side;  // curled fingers
    const std::vector<Ring> finger = {{tip, 0.0075F, 0.0075F, x, bent},
                                      {-0.13F, 0.0085F, 0.0085F, x, 0.3F * bent},
                                      {-0.085F, 0.0095F, 0.010F, x}};
    add_loft(mesh, T, rounded_rings(scaled_rings(finger, scale), 1), material, 5);
  }
  const Eigen::Isometry3f thumb =
      at(0.030F * scale, -0.008F * side * scale, wrist - 0.03F * scale) *
      turned(-0.55F, Eigen::Vector3f::UnitY());
  const std::vector<Ring> rings = {
      {-0.062F, 0.009F, 0.009F}, {-0.03F, 0.011F, 0.011F}, {0.0F, 0.014F, 0.012F}};
  add_loft(mesh, thumb, rounded_rings(scaled_rings(rings, scale), 1), material, 6);
}

}  // namespace

Mesh make_upper_arm(const PersonStyle& style, const PersonProportions& body) {
  Mesh mesh;
  const std::uint32_t sleeve = mesh.add(cloth(style.shirt, style.seed + 7));
  const std::uint32_t skin = mesh.add(skin_of(style));
  const float build = std::sqrt(body.build);
  add_loft(mesh, at(0, 0, 0),
           limb({{-1.0F, 0.024F, 0.023F},
                 {-0.75F, 0.027F, 0.025F},
                 {-0.4F, 0.030F, 0.028F, 0.001F},
                 {-0.12F, 0.034F, 0.031F},
                 {0.0F, 0.029F, 0.024F}},
                body.upper_arm, body.height, build),
           style.short_sleeves ? skin : sleeve, 12);
  if (style.short_sleeves) {
    add_loft(mesh, at(0, 0, 0),
             limb({{-0.62F, 0.034F, 0.033F}, {-0.15F, 0.036F, 0.033F}, {0.0F, 0.031F, 0.026F}},
                  body.upper_arm, body.height, build),
             sleeve, 12);
  }
  return mesh;
}

Mesh make_forearm(const PersonStyle& style, const PersonProportions& body, float side) {
  Mesh mesh;
  const std::uint32_t skin = mesh.add(skin_of(style));
  const std::uint32_t sleeve =
      style.short_sleeves ? skin : mesh.add(cloth(style.shirt, style.seed + 8));
  const float loose = style.short_sleeves ? 0.0F : 0.003F;
  add_loft(mesh, at(0, 0, 0),
           limb({{-0.97F, 0.0165F + loose, 0.014F + loose},
                 {-0.7F, 0.0185F + loose, 0.017F + loose},
                 {-0.3F, 0.0245F + 0.5F * loose, 0.024F + 0.5F * loose},
                 {0.0F, 0.024F, 0.023F}},
                body.forearm, body.height, std::sqrt(body.build)),
           sleeve, 12);
  const Material glove = cloth(0.6F * style.shoes + Eigen::Vector3f(0.1F, 0.1F, 0.1F), 3);
  add_hand(mesh, -body.forearm, body.scale, side, style.gloves ? mesh.add(glove) : skin);
  return mesh;
}

Mesh make_thigh(const PersonStyle& style, const PersonProportions& body) {
  Mesh mesh;
  const std::uint32_t trousers = mesh.add(cloth(style.trousers, style.seed + 9));
  add_loft(mesh, at(0, 0, 0),
           limb({{-1.0F, 0.034F, 0.033F, 0.001F},
                 {-0.8F, 0.037F, 0.036F, 0.003F},
                 {-0.45F, 0.045F, 0.042F, 0.003F},
                 {-0.12F, 0.050F, 0.046F, 0.0F},
                 {0.0F, 0.049F, 0.045F, -0.002F}},
                body.thigh, body.height, std::sqrt(body.build)),
           trousers, 14);
  return mesh;
}

Mesh make_shank(const PersonStyle& style, const PersonProportions& body) {
  Mesh mesh;
  const std::uint32_t trousers = mesh.add(cloth(style.trousers, style.seed + 10));
  std::vector<Ring> rings = limb({{-0.98F, 0.030F, 0.028F, -0.002F},
                                  {-0.8F, 0.029F, 0.028F, -0.004F},
                                  {-0.3F, 0.034F, 0.033F, -0.005F},
                                  {0.0F, 0.034F, 0.033F, 0.001F}},
                                 body.shank, body.height, std::sqrt(body.build));
  rings.erase(rings.begin(), rings.begin() + 3);  // a hem, flat at its lower end
  add_loft(mesh, at(0, 0, 0), rings, trousers, 14);
  return mesh;
}

Mesh make_shoe(const PersonStyle& style, const PersonProportions& body) {
  Mesh mesh;
  Material leather = cloth(style.shoes, style.seed + 11);
  leather.gloss = 0.08F;
  const std::uint32_t upper = mesh.add(leather);
  const std::uint32_t sole = mesh.add(cloth({0.06F, 0.06F, 0.06F}, style.seed + 12));
  const float floor = -body.ankle / body.scale;
  std::vector<Ring> along = {{-0.064F, 0.034F, 0.026F, 0.046F}, {-0.04F, 0.046F, 0.036F, 0.055F},
                             {0.01F, 0.052F, 0.038F, 0.058F},   {0.06F, 0.040F, 0.042F, 0.047F},
                             {0.11F, 0.031F, 0.046F, 0.038F},   {0.15F, 0.028F, 0.044F, 0.034F},
                             {0.178F, 0.020F, 0.034F, 0.027F}};
  for (Ring& ring : along) ring.x += floor;
  add_loft(mesh, lying(), rounded_rings(scaled_rings(smooth_rings(along, 0.04F), body.scale), 2),
           upper, 12);
  const std::vector<Ring> collar = {{floor + 0.05F, 0.048F, 0.039F, -0.006F},
                                    {floor + 0.10F, 0.043F, 0.038F, -0.006F},
                                    {floor + 0.125F, 0.042F, 0.038F, -0.008F}};
  add_loft(mesh, at(0, 0, 0), rounded_rings(scaled_rings(collar, body.scale), 1), upper, 12);
  const float center = 0.5F * (body.toe - body.heel) / body.scale;
  const float half = 0.5F * (body.toe + body.heel) / body.scale;
  const std::vector<Ring> plate = {{floor, half, 0.043F, center},
                                   {floor + 0.012F, half, 0.047F, center},
                                   {floor + 0.026F, half - 0.004F, 0.045F, center}};
  add_loft(mesh, at(0, 0, 0), scaled_rings(plate, body.scale), sole, 18);
  return mesh;
}

}  // namespace mms
