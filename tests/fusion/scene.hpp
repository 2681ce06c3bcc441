#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "mms/core/frame.hpp"
#include "mms/core/segmentation.hpp"

namespace mms::testing {

/// Surfaces of the synthetic scenes.
enum class Surface : std::uint8_t { kNone, kFloor, kWall, kPerson, kOther, kDesk };

struct Block {
  Surface surface;
  Eigen::AlignedBox3f box;  ///< in the camera frame [m]
};

/// Axis-aligned blocks in the frame of a camera at the origin, z forward, y down. The floor is
/// 1.2 m below.
struct Scene {
  std::vector<Block> blocks;

  Scene& add(Surface surface, const Eigen::Vector3f& low, const Eigen::Vector3f& high);

  struct Hit {
    float distance = 0.0F;  ///< as a multiple of `direction`; 0 for none
    Surface surface = Surface::kNone;
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
  Image<Surface> truth;
};

/// The scene's depth image (and a grey color image) with the surface of every pixel.
View render(const Scene& scene);

/// The pixels of `surface` as the mask of one instance, dilated by `grow` pixels (eroded if
/// negative).
Instance mask_of(const View& view, Surface surface, int grow = 0);

Segmentation segmentation_of(const View& view, std::vector<Instance> instances);

}  // namespace mms::testing
