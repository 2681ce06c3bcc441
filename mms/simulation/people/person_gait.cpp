#include "mms/simulation/people/person_gait.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "mms/core/hash_noise.hpp"
#include "mms/simulation/people/person_shapes.hpp"

namespace mms {
namespace {

constexpr float kTurn = 2.0F * std::numbers::pi_v<float>;
constexpr float kStance = 0.62F;    ///< share of a stride during which a foot is on the floor
constexpr float kInFront = 0.46F;   ///< landing position of a foot ahead of the hips [steps]
constexpr float kFullSpeed = 0.4F;  ///< from this speed on steps have full length [m/s]

float smooth(float t) {
  t = std::clamp(t, 0.0F, 1.0F);
  return t * t * (3.0F - 2.0F * t);
}

/// Position of a foot relative to the hips at `cycle` in [0, 1) of its stride [steps].
float foot_ahead(float cycle) {
  const float behind = kInFront - 2.0F * kStance;
  if (cycle < kStance) return kInFront - 2.0F * cycle;
  const float t = (cycle - kStance) / (1.0F - kStance);
  const float slope = -2.0F * (1.0F - kStance);  // continuous velocity at lift-off and landing
  return behind + smooth(t) * (kInFront - behind) + t * (1.0F - t) * (1.0F - 2.0F * t) * slope;
}

/// Downward pitch of the toes [rad]: negative at the heel strike, positive while the heel lifts.
float foot_pitch(float cycle) {
  struct Key {
    float cycle, pitch;
  };
  constexpr std::array<Key, 6> kKeys = {{{0.0F, -0.32F},
                                         {0.10F, 0.0F},
                                         {0.34F, 0.0F},
                                         {0.69F, 0.98F},
                                         {0.90F, -0.12F},
                                         {1.0F, -0.32F}}};
  std::size_t i = 0;
  while (i + 2 < kKeys.size() && cycle >= kKeys[i + 1].cycle) ++i;
  const float share = smooth((cycle - kKeys[i].cycle) / (kKeys[i + 1].cycle - kKeys[i].cycle));
  return kKeys[i].pitch + share * (kKeys[i + 1].pitch - kKeys[i].pitch);
}

/// Height of the sole above the floor during the swing [m].
float foot_clearance(float cycle) {
  if (cycle < kStance) return 0.0F;
  const float t = (cycle - kStance) / (1.0F - kStance);
  return 0.035F * std::pow(std::sin(std::numbers::pi_v<float> * t), 2.0F);
}

/// Frame of a shoe rotated about its ball or its heel, its lowest point `clearance` above the
/// floor.
Eigen::Isometry3f foot_frame(const PersonProportions& body, float x, float y, float pitch,
                             float clearance) {
  const Eigen::Matrix3f R(Eigen::AngleAxisf(pitch, Eigen::Vector3f::UnitY()));
  const float pivot_x = pitch > 0.0F ? body.ball : -body.heel;
  const Eigen::Vector3f pivot(pivot_x, 0.0F, -body.ankle);
  float lowest = std::numeric_limits<float>::max();
  for (const float end : {-body.heel, body.toe}) {
    for (const float edge : {0.0F, 0.012F * body.scale}) {
      lowest = std::min(lowest, (R * Eigen::Vector3f(end, 0.0F, edge - body.ankle)).z());
    }
  }
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  T.linear() = R;
  T.translation() = Eigen::Vector3f(x + pivot_x - (R * pivot).x(), y, clearance - lowest);
  return T;
}

/// Smooth minimum.
template <std::size_t N>
float soft_min(const std::array<float, N>& values) {
  constexpr float kRound = 0.005F;  // [m]
  const float least = *std::min_element(values.begin(), values.end());
  float sum = 0.0F;
  for (const float value : values) sum += std::exp((least - value) / kRound);
  return least - kRound * std::log(sum);
}

/// Largest height of the pelvis at which the leg reaches its foot.
float reach_of(const PersonProportions& body, const Eigen::Isometry3f& T_pelvis, float side,
               const Eigen::Vector3f& ankle) {
  const Eigen::Vector3f hip = T_pelvis.linear() * Eigen::Vector3f(0.0F, side * body.hip_y, 0.0F);
  const Eigen::Vector3f way = ankle - hip - T_pelvis.translation();
  const float reach = 0.996F * body.leg();
  const float flat = way.x() * way.x() + way.y() * way.y();
  return ankle.z() - hip.z() + std::sqrt(std::max(0.01F, reach * reach - flat));
}

/// Pelvis above the feet, without height: it sways to the stance leg and rotates.
Eigen::Isometry3f swaying_pelvis(const PersonProportions& body, const Gait& gait, double seconds,
                                 std::uint32_t seed) {
  const float idle = 1.0F - gait.amount;
  const auto t = static_cast<float>(std::fmod(seconds, 3600.0)) + 7.0F * uniform_of(hash_of(seed));
  const float sway =
      0.018F * gait.amount * std::sin(gait.phase) + 0.008F * idle * std::sin(0.7F * t);
  const float yaw = -0.09F * gait.amount * std::cos(gait.phase);
  const float roll =
      -0.05F * gait.amount * std::sin(gait.phase) + 0.008F * idle * std::sin(0.7F * t);
  return at(0.006F * idle * std::sin(0.5F * t), sway * body.scale, 0.0F) *
         turned(yaw, Eigen::Vector3f::UnitZ()) * turned(roll, Eigen::Vector3f::UnitX());
}

}  // namespace

Gait gait_of(const PersonProportions& body, const Activity& activity, std::uint32_t seed) {
  Gait gait;
  const float step = kStepOverLeg * body.leg();
  gait.amount = smooth(static_cast<float>(std::abs(activity.speed)) / kFullSpeed);
  const double strides = activity.travelled / (2.0 * static_cast<double>(step));
  for (std::size_t i = 0; i < 2; ++i) {
    const double shifted = strides + 0.5 * static_cast<double>(i);
    const auto cycle = static_cast<float>(shifted - std::floor(shifted));
    if (i == 0) gait.phase = kTurn * cycle;
    const float side = i == 0 ? 1.0F : -1.0F;
    const float y = side * body.hip_y * (1.25F - 0.35F * gait.amount);
    const float stand = side * 0.03F * (1.0F - gait.amount);
    gait.T_object_foot[i] =
        foot_frame(body, gait.amount * step * foot_ahead(cycle) + stand, y,
                   gait.amount * foot_pitch(cycle), gait.amount * foot_clearance(cycle)) *
        turned(side * 0.13F, Eigen::Vector3f::UnitZ());
  }
  gait.T_object_pelvis = swaying_pelvis(body, gait, activity.seconds, seed);
  gait.T_object_pelvis.translation().z() = soft_min<3>(
      {body.standing_hip() + 0.004F,
       reach_of(body, gait.T_object_pelvis, 1.0F, gait.T_object_foot[0].translation()),
       reach_of(body, gait.T_object_pelvis, -1.0F, gait.T_object_foot[1].translation())});
  return gait;
}

}  // namespace mms
