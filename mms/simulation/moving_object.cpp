#include "mms/simulation/moving_object.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mms/simulation/hash_noise.hpp"

namespace mms {
namespace {

using Vec = Eigen::Vector3f;

/// Adds the parts of a body, given in the object's frame.
class Body {
 public:
  Body(const MovingObject& object, double seconds)
      : T_room_object_(object.T_room_object(seconds).cast<float>()),
        label_(static_cast<std::uint8_t>(1 + static_cast<int>(object.object_class))),
        seed_(object.seed) {}

  void add(Shape shape, const Vec& center, const Vec& half, const Material& material) {
    add(shape, Eigen::Isometry3f(Eigen::Translation3f(center)), half, material);
  }

  /// A limb of that half length, hanging from `joint` and swung forward by `angle` [rad].
  void limb(const Vec& joint, float angle, const Vec& half, const Material& material) {
    const Eigen::Isometry3f T(Eigen::Translation3f(joint) *
                              Eigen::AngleAxisf(-angle, Vec::UnitY()) *
                              Eigen::Translation3f(0.0F, 0.0F, -half.z()));
    add(Shape::kEllipsoid, T, half, material);
  }

  std::vector<Solid> take() { return std::move(solids_); }

 private:
  void add(Shape shape, const Eigen::Isometry3f& T_object_part, const Vec& half,
           Material material) {
    material.seed = static_cast<std::uint32_t>(hash_of(seed_, solids_.size()));
    solids_.push_back({shape, T_room_object_ * T_object_part, half, material, label_});
  }

  Eigen::Isometry3f T_room_object_;
  std::uint8_t label_;
  std::uint32_t seed_;
  std::vector<Solid> solids_;
};

Vec cloth_color(std::uint32_t seed, int part) {
  const auto value = [&](int channel) {
    return 0.08F + 0.6F * uniform_of(hash_of(seed, static_cast<std::uint64_t>(part * 3 + channel)));
  };
  return {value(0), value(1), value(2)};
}

void add_leg(Body& body, float side, float swing, const Material& trousers, const Material& shoe) {
  constexpr float kThigh = 0.44F;
  const Vec hip(0.0F, side * 0.095F, 0.92F);
  const Vec knee = hip + kThigh * Vec(std::sin(swing), 0.0F, -std::cos(swing));
  const float bent = swing - 0.25F - 0.25F * std::abs(swing);
  const Vec ankle = knee + 0.42F * Vec(std::sin(bent), 0.0F, -std::cos(bent));
  body.limb(hip + Vec(0.0F, 0.0F, 0.06F), swing, {0.095F, 0.09F, 0.27F}, trousers);
  body.limb(knee + Vec(0.0F, 0.0F, 0.05F), bent, {0.07F, 0.065F, 0.25F}, trousers);
  body.add(Shape::kEllipsoid, ankle + Vec(0.06F, 0.0F, 0.0F), {0.14F, 0.05F, 0.05F}, shoe);
}

void add_person(Body& body, std::uint32_t seed, float swing) {
  const Material shirt{Pattern::kStripes, cloth_color(seed, 0), 0.07F, cloth_color(seed, 1)};
  const Material trousers{Pattern::kPlain, 0.6F * cloth_color(seed, 2), 0.06F};
  const Material skin{Pattern::kPlain, {0.80F, 0.60F, 0.48F}, 0.05F};
  const Material hair{Pattern::kPlain, 0.4F * cloth_color(seed, 3), 0.03F};
  body.add(Shape::kEllipsoid, {0.0F, 0.0F, 1.20F}, {0.14F, 0.22F, 0.33F}, shirt);
  body.add(Shape::kEllipsoid, {0.0F, 0.0F, 1.38F}, {0.11F, 0.24F, 0.12F}, shirt);
  body.add(Shape::kEllipsoid, {0.0F, 0.0F, 0.92F}, {0.13F, 0.18F, 0.16F}, trousers);
  body.add(Shape::kEllipsoid, {0.0F, 0.0F, 1.50F}, {0.055F, 0.055F, 0.10F}, skin);
  body.add(Shape::kEllipsoid, {0.01F, 0.0F, 1.63F}, {0.095F, 0.08F, 0.12F}, skin);
  body.add(Shape::kEllipsoid, {-0.015F, 0.0F, 1.665F}, {0.10F, 0.088F, 0.10F}, hair);
  const Material shoe{Pattern::kPlain, {0.1F, 0.1F, 0.1F}, 0.05F};
  for (const float side : {-1.0F, 1.0F}) {
    add_leg(body, side, side * swing, trousers, shoe);
    const Vec shoulder(0.0F, side * 0.235F, 1.43F);
    const float arm = -0.7F * side * swing;
    const Vec elbow = shoulder + 0.30F * Vec(std::sin(arm), 0.0F, -std::cos(arm));
    body.limb(shoulder + Vec(0.0F, 0.0F, 0.04F), arm, {0.055F, 0.055F, 0.18F}, shirt);
    body.limb(elbow, arm + 0.35F, {0.045F, 0.045F, 0.15F}, skin);
  }
}

void add_agv(Body& body) {
  const Material yellow{Pattern::kStripes, {0.85F, 0.65F, 0.1F}, 0.1F, {0.15F, 0.15F, 0.15F}};
  const Material grey{Pattern::kTiles, {0.5F, 0.52F, 0.55F}, 0.15F, {0.2F, 0.2F, 0.2F}};
  const Material dark{Pattern::kPlain, {0.12F, 0.12F, 0.13F}, 0.05F};
  body.add(Shape::kBox, {0.0F, 0.0F, 0.20F}, {0.40F, 0.28F, 0.13F}, yellow);
  body.add(Shape::kBox, {-0.05F, 0.0F, 0.45F}, {0.30F, 0.22F, 0.12F}, grey);
  body.add(Shape::kBox, {0.30F, 0.0F, 0.55F}, {0.03F, 0.03F, 0.22F}, dark);
  body.add(Shape::kEllipsoid, {0.30F, 0.0F, 0.80F}, {0.07F, 0.07F, 0.05F}, dark);
  for (const float x : {-0.27F, 0.27F}) {
    for (const float y : {-0.27F, 0.27F}) {
      body.add(Shape::kEllipsoid, {x, y, 0.09F}, {0.09F, 0.03F, 0.09F}, dark);
    }
  }
}

}  // namespace

Eigen::Vector2d MovingObject::position(double seconds) const {
  const double angle = rate * seconds + phase;
  return center + half.cwiseProduct(Eigen::Vector2d(std::cos(angle), std::sin(angle)));
}

Eigen::Vector2d MovingObject::velocity(double seconds) const {
  const double angle = rate * seconds + phase;
  return rate * half.cwiseProduct(Eigen::Vector2d(-std::sin(angle), std::cos(angle)));
}

Eigen::Isometry3d MovingObject::T_room_object(double seconds) const {
  const Eigen::Vector2d p = position(seconds);
  const Eigen::Vector2d v = velocity(seconds);
  return Eigen::Translation3d(p.x(), p.y(), 0.0) *
         Eigen::AngleAxisd(std::atan2(v.y(), v.x()), Eigen::Vector3d::UnitZ()) *
         Eigen::Isometry3d::Identity();
}

std::vector<Solid> MovingObject::solids(double seconds) const {
  Body body(*this, seconds);
  if (object_class == ObjectClass::kAgv) {
    add_agv(body);
  } else {
    constexpr double kStepsPerRadian = 5.0;  // about 1.4 m for two steps on the longest ways
    const double stride = std::sin(kStepsPerRadian * (rate * seconds + phase));
    add_person(body, seed, static_cast<float>(0.45 * stride));
  }
  return body.take();
}

Eigen::Vector3d MovingObject::half_extent() const {
  return object_class == ObjectClass::kAgv ? Eigen::Vector3d(0.40, 0.30, 0.425)
                                           : Eigen::Vector3d(0.55, 0.30, 0.885);
}

std::vector<MovingObject> moving_objects(int people, std::uint32_t seed) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const auto random = [&](int i) {
    return static_cast<double>(uniform_of(hash_of(seed, 77U + static_cast<std::uint64_t>(i))));
  };
  std::vector<MovingObject> objects;
  for (int i = 0; i < people; ++i) {
    MovingObject person;
    person.center = {-0.1 + 1.6 * i / std::max(people, 3), 0.1 * (i % 4)};
    person.half = {0.05, 1.7 - 0.15 * (i % 3)};
    person.rate = (i % 2 == 0 ? 1.0 : -1.0) * (0.55 + 0.15 * random(2 * i));
    person.phase = kTurn * (random(2 * i + 1) + i / 3.0);
    person.seed = static_cast<std::uint32_t>(hash_of(seed, 500U + static_cast<unsigned>(i)));
    objects.push_back(person);
  }
  MovingObject agv;
  agv.object_class = ObjectClass::kAgv;
  agv.center = {1.5, -0.3};
  agv.half = {0.06, 1.2};
  agv.rate = 0.4;
  agv.phase = kTurn * random(99);
  agv.seed = seed + 1;
  objects.push_back(agv);
  return objects;
}

}  // namespace mms
