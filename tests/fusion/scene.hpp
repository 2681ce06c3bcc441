#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "mms/core/frame.hpp"
#include "mms/core/segmentation.hpp"

namespace mms::testing {

/// What a ray of the synthetic scenes hits.
enum class Thing : std::uint8_t { kNothing, kFloor, kWall, kPerson, kOther, kDesk };

struct Block {
  Thing thing;
  Eigen::AlignedBox3f box;  ///< in the camera frame [m]
};

/// Axis-aligned blocks seen from the origin, z forward, y down; the floor is 1.2 m below.
struct Scene {
  std::vector<Block> blocks;

  Scene& add(Thing thing, const Eigen::Vector3f& low, const Eigen::Vector3f& high);

  struct Hit {
    float distance = 0.0F;  ///< in lengths of `direction`; 0 for none
    Thing thing = Thing::kNothing;
  };
  Hit cast(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;
};

/// A floor and a wall 4 m away.
Scene room();

/// `room` with a person of 0.5 x 1.7 x 0.3 m standing 2.5 m away, its left side at `x` [m].
Scene room_with_person(float x = -0.25F);

CameraIntrinsics test_camera();

struct View {
  Frame frame;
  Image<Thing> truth;
};

/// The scene's depth image (and a grey colour image) with what every pixel sees.
View render(const Scene& scene);

/// The pixels of `thing` as one instance's mask, moved outwards by `grow` pixels (inwards if
/// negative).
Instance mask_of(const View& view, Thing thing, int grow = 0);

Segmentation segmentation_of(const View& view, std::vector<Instance> instances);

}  // namespace mms::testing
