#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mms/core/image.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/geometry/camera.hpp"
#include "mms/geometry/depth_noise.hpp"

namespace mms {

/// The static depth of one image, to be compared with that of another one: at all its pixels, and
/// at the nodes of a coarse grid.
class DepthView {
 public:
  /// Point of the grid.
  struct Node {
    Eigen::Vector3f point = Eigen::Vector3f::Zero();  ///< [m]; zero without a static return
    std::uint8_t grey = 0;                            ///< [grey levels]; 0 without a color image
    bool is_masked = false;                           ///< by a moving object

    bool is_valid() const { return point.z() > 0.0F; }
  };

  /// @param cloud  organized
  DepthView(const LabeledCloud& cloud, const DepthNoise& noise);

  /// Of the grid of the cloud's points.
  const CameraIntrinsics& camera() const { return camera_.intrinsics(); }
  const Image<Node>& nodes() const { return nodes_; }
  int valid_nodes() const { return valid_nodes_; }

  /// What the view shows in the direction of a point.
  enum class Seen : std::uint8_t {
    kNothing,  ///< no static return there, or out of view
    kSame,     ///< a surface at the point
    kOther     ///< a surface nearer or farther
  };

  /// @param point   in the sensor frame of the view [m]
  /// @param hidden  non-zero at nodes around which nothing is known; may be empty
  Seen at(const Eigen::Vector3f& point, const Image<std::uint8_t>& hidden) const;

  /// Whether depth or brightness at a node differ from those of another view. Unknown ones do not.
  bool has_changed(int x, int y, const DepthView& other) const;

 private:
  CameraModel camera_;
  DepthNoise noise_;
  Image<float> depth_;  // [m], 0 without a static return
  Image<Node> nodes_;
  int valid_nodes_ = 0;
};

/// [-]: points of a cloud between two nodes along either axis. Source: computing time, 0.2
/// ms/frame.
inline constexpr int kNodeStep = 4;

}  // namespace mms
