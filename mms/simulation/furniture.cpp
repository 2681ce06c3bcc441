#include "mms/simulation/furniture.hpp"

#include "mms/simulation/hash_noise.hpp"

namespace mms {
namespace {

using Vec = Eigen::Vector3f;

/// Collects boxes; every one has a texture of its own.
class Builder {
 public:
  explicit Builder(std::uint32_t seed) : seed_(seed) {}

  void box(const Vec& center, const Vec& half, Material material) {
    material.seed = next();
    solids_.push_back(Solid::at(Shape::kBox, center, half, material));
  }

  Vec any_color() { return Vec(value(), value(), value()); }

  std::vector<Solid> take() { return std::move(solids_); }

 private:
  std::uint32_t next() { return static_cast<std::uint32_t>(hash_of(seed_, ++count_)); }
  float value() { return 0.15F + 0.8F * uniform_of(hash_of(seed_ + 1000, ++count_)); }

  std::uint32_t seed_;
  std::uint64_t count_ = 0;
  std::vector<Solid> solids_;
};

void add_walls(Builder& room) {
  const Material wall{Pattern::kPlaster, {0.78F, 0.75F, 0.68F}, 0.12F};
  const Material side{Pattern::kPlaster, {0.62F, 0.70F, 0.72F}, 0.10F};
  const Material floor{Pattern::kPlanks, {0.55F, 0.40F, 0.27F}, 0.14F};
  const Material ceiling{Pattern::kTiles, {0.85F, 0.85F, 0.83F}, 0.6F, {0.5F, 0.5F, 0.5F}};
  room.box({0.0F, 0.0F, -0.05F}, {3.1F, 2.6F, 0.05F}, floor);
  room.box({0.0F, 0.0F, 3.05F}, {3.1F, 2.6F, 0.05F}, ceiling);
  room.box({3.05F, 0.0F, 1.5F}, {0.05F, 2.6F, 1.5F}, wall);
  room.box({-3.05F, 0.0F, 1.5F}, {0.05F, 2.6F, 1.5F}, wall);
  room.box({0.0F, 2.55F, 1.5F}, {3.1F, 0.05F, 1.5F}, side);
  room.box({0.0F, -2.55F, 1.5F}, {3.1F, 0.05F, 1.5F}, side);
}

void add_posters(Builder& room) {
  const auto poster = [&](float scale) {
    return Material{Pattern::kPoster, room.any_color(), scale, room.any_color()};
  };
  const Material skirting{Pattern::kPlain, {0.35F, 0.3F, 0.27F}, 0.1F};
  room.box({2.99F, -0.2F, 1.75F}, {0.01F, 0.45F, 0.33F}, poster(0.07F));
  room.box({2.99F, 1.1F, 1.6F}, {0.01F, 0.30F, 0.42F}, poster(0.05F));
  room.box({2.99F, -1.6F, 1.9F}, {0.01F, 0.4F, 0.28F}, poster(0.06F));
  room.box({0.4F, -2.49F, 1.6F}, {0.5F, 0.01F, 0.36F}, poster(0.08F));
  room.box({2.1F, -2.49F, 1.9F}, {0.35F, 0.01F, 0.25F}, poster(0.05F));
  room.box({0.2F, 2.49F, 1.7F}, {0.4F, 0.01F, 0.4F}, poster(0.07F));
  room.box({-1.6F, 2.49F, 1.6F}, {0.4F, 0.01F, 0.3F}, poster(0.06F));
  room.box({-2.99F, 0.3F, 1.6F}, {0.01F, 0.6F, 0.4F}, poster(0.08F));
  room.box({2.98F, 0.0F, 0.06F}, {0.02F, 2.5F, 0.06F}, skirting);
}

void add_table(Builder& room) {
  const Material wood{Pattern::kPlanks, {0.70F, 0.52F, 0.33F}, 0.10F};
  const Material steel{Pattern::kPlain, {0.25F, 0.25F, 0.28F}, 0.05F};
  const Vec center(2.25F, -0.75F, 0.0F);
  room.box(center + Vec(0.0F, 0.0F, 0.73F), {0.38F, 0.75F, 0.02F}, wood);
  for (const float x : {-0.33F, 0.33F}) {
    for (const float y : {-0.7F, 0.7F}) {
      room.box(center + Vec(x, y, 0.355F), {0.025F, 0.025F, 0.355F}, steel);
    }
  }
  const Material screen{Pattern::kPoster, {0.1F, 0.12F, 0.2F}, 0.04F, {0.2F, 0.5F, 0.6F}};
  room.box(center + Vec(0.15F, -0.1F, 1.0F), {0.02F, 0.28F, 0.17F}, screen);
  room.box(center + Vec(0.15F, -0.1F, 0.79F), {0.06F, 0.06F, 0.04F}, steel);
  room.box(center + Vec(-0.1F, 0.45F, 0.83F), {0.12F, 0.15F, 0.08F},
           {Pattern::kStripes, room.any_color(), 0.04F, room.any_color()});
}

void add_shelves(Builder& room) {
  const Material board{Pattern::kPlain, {0.45F, 0.32F, 0.22F}, 0.08F};
  const Vec center(1.7F, 2.28F, 0.0F);
  for (const float x : {-0.7F, 0.7F}) {
    room.box(center + Vec(x, 0.0F, 0.95F), {0.02F, 0.2F, 0.95F}, board);
  }
  for (const float z : {0.1F, 0.55F, 1.0F, 1.45F, 1.88F}) {
    room.box(center + Vec(0.0F, 0.0F, z), {0.7F, 0.2F, 0.015F}, board);
  }
  float x = -0.5F;
  for (const float z : {0.27F, 0.70F, 1.16F, 1.6F}) {
    for (int i = 0; i < 3; ++i) {
      const float height = 0.10F + 0.02F * static_cast<float>(i);
      room.box(center + Vec(x, -0.02F, z - 0.15F + height), {0.14F, 0.13F, height},
               {Pattern::kStripes, room.any_color(), 0.05F, room.any_color()});
      x = x > 0.3F ? -0.5F : x + 0.37F;
    }
  }
}

void add_boxes(Builder& room) {
  const Material card{Pattern::kStripes, {0.66F, 0.50F, 0.33F}, 0.16F, {0.55F, 0.40F, 0.25F}};
  const Material blue{Pattern::kTiles, {0.2F, 0.32F, 0.5F}, 0.2F, {0.1F, 0.15F, 0.25F}};
  const Material cabinet{Pattern::kTiles, {0.62F, 0.63F, 0.6F}, 0.45F, {0.2F, 0.2F, 0.2F}};
  room.box({2.6F, 1.35F, 0.25F}, {0.3F, 0.35F, 0.25F}, card);
  room.box({2.65F, 1.4F, 0.68F}, {0.22F, 0.25F, 0.18F}, card);
  room.box({2.65F, 0.55F, 0.2F}, {0.25F, 0.25F, 0.2F}, blue);
  room.box({0.9F, -2.2F, 0.45F}, {0.45F, 0.28F, 0.45F}, cabinet);
  room.box({0.8F, -2.2F, 1.02F}, {0.2F, 0.15F, 0.12F}, card);
  room.box({-1.0F, 2.1F, 0.35F}, {0.35F, 0.3F, 0.35F}, blue);
  room.box({2.5F, -2.1F, 0.9F}, {0.3F, 0.3F, 0.9F}, cabinet);
}

}  // namespace

std::vector<Solid> furnished_room(std::uint32_t seed) {
  Builder room(seed);
  add_walls(room);
  add_posters(room);
  add_table(room);
  add_shelves(room);
  add_boxes(room);
  return room.take();
}

}  // namespace mms
