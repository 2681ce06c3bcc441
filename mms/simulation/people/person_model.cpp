#include "mms/simulation/people/person_model.hpp"

#include <string>

#include "mms/core/error.hpp"
#include "mms/simulation/people/person_bend.hpp"
#include "mms/simulation/people/person_gait.hpp"
#include "mms/simulation/people/person_parts.hpp"
#include "mms/simulation/people/person_posture.hpp"
#include "mms/simulation/people/person_shapes.hpp"

namespace mms {
namespace {

std::vector<Mesh> make_parts(const PersonStyle& style, const PersonProportions& body) {
  std::vector<Mesh> parts = {make_pelvis(style, body),
                             make_torso(style, body),
                             make_head(style, body),
                             make_upper_arm(style, body),
                             make_upper_arm(style, body),
                             make_forearm(style, body, 1.0F),
                             make_forearm(style, body, -1.0F),
                             make_thigh(style, body),
                             make_thigh(style, body),
                             make_shank(style, body),
                             make_shank(style, body),
                             make_shoe(style, body),
                             make_shoe(style, body)};
  if (style.carries_box) parts.push_back(make_carried_box(style, body));
  return parts;
}

class Person : public ArticulatedModel {
 public:
  explicit Person(const PersonStyle& style)
      : style_(style), body_(style.height, style.build), parts_(make_parts(style_, body_)) {}

  ObjectClass object_class() const override { return ObjectClass::kPerson; }
  std::string kind() const override { return "person"; }
  const std::vector<Mesh>& parts() const override { return parts_; }

  std::vector<Eigen::Isometry3f> pose(const Activity& activity) const override {
    const Gait gait = gait_of(body_, activity, style_.seed);
    const Posture posture = posture_of(style_, body_, gait, activity.seconds);
    std::vector<Eigen::Isometry3f> poses(parts_.size(), posture.T_object_torso);
    poses[PersonPart::kPelvis] = gait.T_object_pelvis;
    poses[PersonPart::kHead] = posture.T_object_head;
    for (std::size_t i = 0; i < 2; ++i) {
      const BentLimb arm = bend_limb(posture.shoulders[i], posture.wrists[i],
                                     posture.arm_forward[i], body_.upper_arm, body_.forearm, false);
      poses[PersonPart::kLeftUpperArm + i] = arm.upper;
      const float palm = i == 0 ? -posture.palms_down : posture.palms_down;
      poses[PersonPart::kLeftForearm + i] = arm.lower * turned(palm, Eigen::Vector3f::UnitZ());
      place_leg(gait, i, poses);
    }
    return poses;
  }

 private:
  void place_leg(const Gait& gait, std::size_t i, std::vector<Eigen::Isometry3f>& poses) const {
    const float side = i == 0 ? 1.0F : -1.0F;
    const Eigen::Vector3f hip =
        gait.T_object_pelvis * Eigen::Vector3f(0.0F, side * body_.hip_y, 0.0F);
    const Eigen::Isometry3f& foot = gait.T_object_foot[i];
    const Eigen::Vector3f toes(1.0F, 0.13F * side, 0.0F);
    const BentLimb leg = bend_limb(hip, foot.translation(), toes, body_.thigh, body_.shank, true);
    poses[PersonPart::kLeftThigh + i] = leg.upper;
    poses[PersonPart::kLeftShank + i] = leg.lower;
    poses[PersonPart::kLeftShoe + i] = foot;
  }

  PersonStyle style_;
  PersonProportions body_;
  std::vector<Mesh> parts_;
};

void check(const std::string& what, float value, float low, float high) {
  if (value >= low && value <= high) return;
  throw Error("person style",
              what + " = " + std::to_string(value) + " is outside [" + std::to_string(low) + ", " +
                  std::to_string(high) + "]",
              "use random_person_style");
}

}  // namespace

std::unique_ptr<ArticulatedModel> make_person(const PersonStyle& style) {
  check("height", style.height, 1.2F, 2.2F);
  check("build", style.build, 0.7F, 1.5F);
  return std::make_unique<Person>(style);
}

}  // namespace mms
