#include "mms/simulation/vehicles/agv_parts.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace mms {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

}  // namespace

Eigen::Isometry3f across() {
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  T.linear().col(0) = Eigen::Vector3f::UnitX();
  T.linear().col(1) = -Eigen::Vector3f::UnitZ();
  T.linear().col(2) = Eigen::Vector3f::UnitY();
  return T;
}

void add_block(Mesh& mesh, const Eigen::Vector3f& low, const Eigen::Vector3f& high,
               std::uint32_t material) {
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  T.translation() = 0.5F * (low + high);
  add_box(mesh, T, 0.5F * (high - low), material);
}

void add_bevelled(Mesh& mesh, const Eigen::Vector3f& low, const Eigen::Vector3f& high, float bevel,
                  std::uint32_t material) {
  const Eigen::Vector3f center = 0.5F * (low + high);
  const Eigen::Vector3f half = 0.5F * (high - low);
  const auto outline = [&](float length, float inset) {
    const float top = half.z() - inset;
    return std::vector<Eigen::Vector2f>{{-length, -top},       {length, -top},
                                        {length, top - bevel}, {length - bevel, top},
                                        {bevel - length, top}, {-length, top - bevel}};
  };
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  T.translation() = center;
  add_prism(mesh, T, outline(half.x(), 0.0F), half.y() - bevel, material);
  add_prism(mesh, T, outline(half.x() - bevel, 0.6F * bevel), half.y(), material);
}

void add_bar(Mesh& mesh, const Eigen::Vector3f& from, const Eigen::Vector3f& to, float radius,
             std::uint32_t material, int segments) {
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  T.linear() =
      Eigen::Quaternionf::FromTwoVectors(Eigen::Vector3f::UnitZ(), to - from).toRotationMatrix();
  T.translation() = 0.5F * (from + to);
  add_cylinder(mesh, T, radius, 0.5F * (to - from).norm(), material, segments);
}

void add_wheel(AgvAssembly& agv, const AgvStyle& style, float x, float y, float radius, float width,
               const Material& hub) {
  Mesh mesh;
  const std::uint32_t tyre = mesh.add(style.rubber());
  const std::uint32_t disc = mesh.add(hub);
  const float half = 0.5F * width;
  const std::array<Ring, 6> rings = {{{-half, 0.80F * radius, 0.80F * radius},
                                      {-0.8F * half, 0.95F * radius, 0.95F * radius},
                                      {-0.5F * half, radius, radius},
                                      {0.5F * half, radius, radius},
                                      {0.8F * half, 0.95F * radius, 0.95F * radius},
                                      {half, 0.80F * radius, 0.80F * radius}}};
  add_loft(mesh, across(), rings, tyre, 28);
  add_cylinder(mesh, across(), 0.58F * radius, 1.04F * half, disc, 20);
  add_cylinder(mesh, across(), 0.16F * radius, 1.25F * half, tyre, 12);
  for (int i = 0; i < 5; ++i) {
    const float angle = 0.4F * kPi * static_cast<float>(i);
    const Eigen::Isometry3f T =
        at(0.38F * radius * std::cos(angle), 0.0F, 0.38F * radius * std::sin(angle)) * across();
    add_cylinder(mesh, T, 0.08F * radius, 1.12F * half, tyre, 8);
  }
  agv.add(std::move(mesh), AgvAssembly::kBody, [=](const Activity& activity) {
    const double turns =
        activity.travelled / (2.0 * std::numbers::pi * static_cast<double>(radius));
    const float angle = 2.0F * kPi * static_cast<float>(turns - std::floor(turns));
    return at(x, y, radius) * Eigen::AngleAxisf(angle, Eigen::Vector3f::UnitY());
  });
}

void add_lamp(Mesh& mesh, const Eigen::Isometry3f& T, const AgvStyle& style, float size) {
  const std::uint32_t dark = mesh.add(style.dark());
  const std::uint32_t glass = mesh.add(style.glow({1.0F, 0.45F, 0.05F}));
  add_cylinder(mesh, T * at(0, 0, 0.2F * size), 0.55F * size, 0.2F * size, dark, 14);
  const std::array<Ring, 4> dome = {{{0.4F * size, 0.45F * size, 0.45F * size},
                                     {1.0F * size, 0.42F * size, 0.42F * size},
                                     {1.3F * size, 0.28F * size, 0.28F * size},
                                     {1.4F * size, 0.05F * size, 0.05F * size}}};
  add_loft(mesh, T, dome, glass, 14);
}

void add_lidar(Mesh& mesh, const Eigen::Isometry3f& T, const AgvStyle& style, float radius,
               float height) {
  const std::uint32_t dark = mesh.add(style.dark());
  const std::uint32_t window = mesh.add(style.glow({0.16F, 0.10F, 0.14F}));
  const std::uint32_t lid = mesh.add(style.trim());
  const auto ring = [&](float z, float r) { return Ring{z * height, r * radius, r * radius}; };
  const std::array<Ring, 2> foot = {ring(0.0F, 1.0F), ring(0.38F, 1.0F)};
  const std::array<Ring, 2> glass = {ring(0.38F, 0.88F), ring(0.72F, 0.92F)};
  const std::array<Ring, 4> cover = {ring(0.72F, 1.0F), ring(0.86F, 1.0F), ring(0.96F, 0.85F),
                                     ring(1.0F, 0.6F)};
  add_loft(mesh, T, foot, dark, 20);
  add_loft(mesh, T, glass, window, 20);
  add_loft(mesh, T, cover, lid, 20);
}

void add_hazard_plate(Mesh& mesh, const Eigen::Vector3f& low, const Eigen::Vector3f& high,
                      const AgvStyle& style) {
  add_block(mesh, low, high, mesh.add(style.hazard()));
}

}  // namespace mms
