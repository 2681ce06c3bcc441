#pragma once

#include <cmath>

namespace mms {

/// Lengths of a body [m], as shares of its height after anthropometric tables.
struct PersonProportions {
  float height;
  float scale;  ///< relative to a height of 1.75 m
  float build;  ///< of widths

  float ankle;       ///< from the floor to the ankle joint
  float shank;       ///< ankle to knee
  float thigh;       ///< knee to hip
  float hip_y;       ///< from the center to a hip joint
  float waist;       ///< from the hips to the joint of the torso
  float shoulder_y;  ///< from the center to a shoulder
  float shoulder_z;  ///< from the waist to the shoulders
  float neck;        ///< from the waist to the joint of the head
  float upper_arm;   ///< shoulder to elbow
  float forearm;     ///< elbow to wrist
  float heel;        ///< from the ankle back to the heel
  float ball;        ///< from the ankle forward to the ball of the foot
  float toe;         ///< from the ankle forward to the tip of the shoe

  PersonProportions(float body_height, float body_build)
      : height(body_height),
        scale(body_height / 1.75F),
        build(body_build),
        ankle(0.048F * height),
        shank(0.243F * height),
        thigh(0.243F * height),
        hip_y(0.052F * height * std::sqrt(build)),
        waist(0.055F * height),
        shoulder_y(0.103F * height * std::sqrt(build)),
        shoulder_z(0.211F * height),
        neck(0.252F * height),
        upper_arm(0.172F * height),
        forearm(0.150F * height),
        heel(0.040F * height),
        ball(0.074F * height),
        toe(0.115F * height) {}

  float leg() const { return thigh + shank; }

  /// Height of the hips of a standing person, with almost straight knees.
  float standing_hip() const { return ankle + 0.994F * leg(); }
};

}  // namespace mms
