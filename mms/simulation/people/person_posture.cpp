#include "mms/simulation/people/person_posture.hpp"

#include <cmath>

#include "mms/core/hash_noise.hpp"
#include "mms/simulation/people/person_parts.hpp"
#include "mms/simulation/people/person_shapes.hpp"

namespace mms {
namespace {

/// Phases of a person's periodic motions, which differ between persons.
struct Habit {
  float seconds;

  Habit(double time, std::uint32_t seed)
      : seconds(static_cast<float>(std::fmod(time, 3600.0)) +
                30.0F * uniform_of(hash_of(seed, 3))) {}
  float wave(float rate) const { return std::sin(rate * seconds); }
};

/// Height of a worker's hands: 0 at the lowest shelf, 1 at the highest.
float shelf(const Habit& habit) {
  return 0.5F + 0.42F * habit.wave(0.95F) + 0.08F * habit.wave(2.3F);
}

/// Degree of working, 0 to 1: not while walking or carrying.
float working(const PersonStyle& style, const Gait& gait) {
  return style.working && !style.carries_box ? 1.0F - gait.amount : 0.0F;
}

Eigen::Isometry3f torso_turn(const PersonStyle& style, const Gait& gait, const Habit& habit) {
  const float work = working(style, gait);
  const float idle = 1.0F - gait.amount;
  const float lean = 0.05F * gait.amount + work * (0.06F + 0.40F * (1.0F - shelf(habit))) +
                     0.008F * idle * habit.wave(1.3F) - (style.carries_box ? 0.07F : 0.0F);
  const float swing = style.carries_box ? 0.08F : 0.17F;
  const float yaw = swing * gait.amount * std::cos(gait.phase) + 0.02F * idle * habit.wave(0.4F) +
                    0.15F * work * habit.wave(0.6F);
  const float roll = 0.04F * gait.amount * std::sin(gait.phase);
  return turned(yaw, Eigen::Vector3f::UnitZ()) * turned(roll, Eigen::Vector3f::UnitX()) *
         turned(lean, Eigen::Vector3f::UnitY());
}

/// Wrist of a swinging arm, relative to its shoulder in the frame of the torso.
Eigen::Vector3f swinging_wrist(const PersonProportions& body, const Gait& gait, const Habit& habit,
                               float side) {
  const float wave = -side * std::cos(gait.phase);  // opposite to the leg of the same side
  const float swing = gait.amount * (-0.03F + 0.40F * wave) + 0.02F * habit.wave(0.8F);
  const float elbow = 0.22F + gait.amount * (0.16F + 0.20F * wave);
  const float spread = side * (0.10F + 0.01F * habit.wave(1.1F));
  const Eigen::Isometry3f T = turned(spread, Eigen::Vector3f::UnitX()) *
                              turned(-swing, Eigen::Vector3f::UnitY()) * at(0, 0, -body.upper_arm) *
                              turned(-elbow, Eigen::Vector3f::UnitY()) * at(0, 0, -body.forearm);
  return T.translation() - Eigen::Vector3f(0.0F, 0.02F * side, 0.0F);
}

/// Wrist of a worker at shelves, relative to the waist without the torso's inclination.
Eigen::Vector3f working_wrist(const PersonProportions& body, const Habit& habit, float side) {
  const float high = shelf(habit) + 0.06F * side * habit.wave(1.7F);
  const float ahead = 0.275F - 0.06F * high + 0.015F * habit.wave(1.9F + 0.2F * side);
  return body.height *
         Eigen::Vector3f(ahead, side * 0.115F + 0.02F * habit.wave(0.6F), -0.02F + 0.37F * high);
}

Eigen::Vector3f carrying_wrist(const PersonStyle& style, const PersonProportions& body,
                               float side) {
  const Eigen::Vector3f half = carried_box_half(style);
  const Eigen::Vector3f place(-0.06F, side * (half.y() + 0.022F * body.scale), -0.3F * half.z());
  return carried_box_center(style, body) + place;
}

Eigen::Isometry3f head_turn(const PersonStyle& style, const Gait& gait, const Habit& habit) {
  const float work = working(style, gait);
  const float yaw = -0.10F * gait.amount * std::cos(gait.phase) +
                    0.22F * habit.wave(0.37F) * habit.wave(0.21F) * (1.0F - 0.5F * work);
  const float pitch = 0.02F + work * (0.18F - 0.45F * shelf(habit)) + 0.02F * habit.wave(0.5F);
  return turned(yaw, Eigen::Vector3f::UnitZ()) * turned(pitch, Eigen::Vector3f::UnitY());
}

/// Forward direction of an arm: up for raised arms, so that elbows point down.
Eigen::Vector3f before_arm(const PersonStyle& style, const Gait& gait, float side) {
  const float raised = style.carries_box ? 0.5F : working(style, gait);
  return Eigen::Vector3f(1.0F - 0.4F * raised, -side * (0.1F + 0.4F * raised),
                         0.05F + 0.9F * raised);
}

}  // namespace

Posture posture_of(const PersonStyle& style, const PersonProportions& body, const Gait& gait,
                   double seconds) {
  const Habit habit(seconds, style.seed);
  Posture posture;
  const Eigen::Isometry3f T_object_waist = gait.T_object_pelvis * at(0, 0, body.waist);
  posture.T_object_torso = T_object_waist * torso_turn(style, gait, habit);
  const Eigen::Isometry3f& T = posture.T_object_torso;
  posture.T_object_head =
      T * at(-0.004F * body.height, 0, body.neck) * head_turn(style, gait, habit);
  const float work = working(style, gait);
  posture.palms_down = 1.3F * work;
  for (std::size_t i = 0; i < 2; ++i) {
    const float side = i == 0 ? 1.0F : -1.0F;
    const Eigen::Vector3f shoulder(-0.006F * body.height, side * body.shoulder_y, body.shoulder_z);
    posture.shoulders[i] = T * shoulder;
    Eigen::Vector3f wrist = T * Eigen::Vector3f(shoulder + swinging_wrist(body, gait, habit, side));
    if (work > 0.0F) {
      wrist += work * (T_object_waist * working_wrist(body, habit, side) - wrist);
    }
    if (style.carries_box) wrist = T * carrying_wrist(style, body, side);
    posture.wrists[i] = wrist;
    posture.arm_forward[i] = T.linear() * before_arm(style, gait, side);
  }
  return posture;
}

}  // namespace mms
