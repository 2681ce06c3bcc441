#include <array>
#include <vector>

#include "mms/simulation/vehicles/agv_kinds.hpp"
#include "mms/simulation/vehicles/agv_parts.hpp"

namespace mms {
namespace {

/// Body with rounded flanks, black deck, row of sonars and a laser scanner.
Mesh make_body(const AgvStyle& style) {
  Mesh mesh;
  Material red = style.paint();
  red.color = style.chance(70, 0.75F) ? Eigen::Vector3f(0.72F, 0.06F, 0.05F) : red.color;
  const std::uint32_t paint = mesh.add(red);
  const std::uint32_t dark = mesh.add(style.dark());
  const std::vector<Eigen::Vector2f> profile = {{-0.20F, 0.075F}, {0.16F, 0.075F}, {0.20F, 0.11F},
                                                {0.20F, 0.19F},   {0.16F, 0.215F}, {-0.17F, 0.215F},
                                                {-0.205F, 0.18F}};
  add_prism(mesh, at(0, 0, 0), profile, 0.125F, paint);
  const std::array<Ring, 2> deck = {{{0.214F, 0.225F, 0.185F}, {0.232F, 0.225F, 0.185F}}};
  add_loft(mesh, at(0, 0, 0), deck, dark, 28);
  const std::array<Ring, 2> nose = {
      {{0.135F, 0.205F, 0.15F, 0.015F}, {0.214F, 0.205F, 0.16F, 0.015F}}};
  add_loft(mesh, at(0, 0, 0), nose, dark, 28);
  const std::uint32_t sonar = mesh.add(style.glow({0.72F, 0.60F, 0.30F}));
  for (int i = -3; i <= 3; ++i) {
    Eigen::Isometry3f T = at(0.015F, 0, 0.175F);
    T.rotate(Eigen::AngleAxisf(0.33F * static_cast<float>(i), Eigen::Vector3f::UnitZ()));
    const float out = 0.205F - 0.005F * static_cast<float>(i * i);
    T = T * at(out, 0, 0);
    T.rotate(Eigen::AngleAxisf(1.5707963F, Eigen::Vector3f::UnitY()));
    add_cylinder(mesh, T, 0.017F, 0.006F, sonar, 12);
  }
  add_block(mesh, {-0.10F, -0.127F, 0.12F}, {0.10F, 0.127F, 0.16F}, mesh.add(style.sticker()));
  return mesh;
}

/// Square laser scanner: a block with a dark slit around the front.
Mesh make_laser(const AgvStyle& style) {
  Mesh mesh;
  Material shell = style.chance(71, 0.5F) ? style.trim() : style.paint();
  shell.color = style.chance(72, 0.5F) ? Eigen::Vector3f(0.16F, 0.28F, 0.55F) : shell.color;
  const std::uint32_t paint = mesh.add(shell);
  add_bevelled(mesh, {-0.07F, -0.075F, 0.0F}, {0.07F, 0.075F, 0.07F}, 0.012F, paint);
  const std::array<Ring, 2> slit = {
      {{0.068F, 0.062F, 0.066F, 0.008F}, {0.105F, 0.062F, 0.066F, 0.008F}}};
  add_loft(mesh, at(0, 0, 0), slit, mesh.add(style.dark()), 20);
  add_bevelled(mesh, {-0.07F, -0.075F, 0.104F}, {0.07F, 0.075F, 0.15F}, 0.015F, paint);
  return mesh;
}

/// Mast with a small camera, and an antenna.
Mesh make_mast(const AgvStyle& style) {
  Mesh mesh;
  const std::uint32_t dark = mesh.add(style.dark());
  add_bar(mesh, {0, 0, 0}, {0, 0, 0.22F}, 0.012F, mesh.add(style.steel()));
  add_block(mesh, {-0.02F, -0.06F, 0.21F}, {0.02F, 0.06F, 0.245F}, dark);
  add_bar(mesh, {0.0F, 0.12F, 0.0F}, {0.0F, 0.12F, 0.20F}, 0.005F, dark, 8);
  return mesh;
}

}  // namespace

std::unique_ptr<ArticulatedModel> make_pioneer(std::uint64_t seed) {
  const AgvStyle style(seed);
  AgvAssembly agv;
  agv.add(make_body(style), AgvAssembly::kBody, at(0, 0, 0));
  agv.add(make_laser(style), AgvAssembly::kBody, at(0.10F, 0, 0.231F));
  if (style.chance(73, 0.6F)) {
    agv.add(make_mast(style), AgvAssembly::kBody,
            style.swing(74, 10.0F, Eigen::Vector3f::UnitZ(), 0.0F, 0.4F, at(-0.11F, 0, 0.231F)));
  }
  Material hub = style.glow({0.80F, 0.78F, 0.72F});
  if (style.chance(75, 0.4F)) hub = style.trim();
  for (const float y : {-0.165F, 0.165F}) add_wheel(agv, style, 0.05F, y, 0.098F, 0.05F, hub);
  add_wheel(agv, style, -0.17F, 0.0F, 0.0375F, 0.03F, style.steel());
  return agv.finish("pioneer");
}

}  // namespace mms
