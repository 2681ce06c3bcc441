#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <deque>
#include <vector>

#include "mms/geometry/depth_noise.hpp"
#include "mms/global_map/keyframes/keyframe_record.hpp"
#include "mms/global_map/loops/point_alignment.hpp"

namespace mms {

/// Keypoints of successive keyframes in one frame. The vectors are parallel.
struct PlacedKeypoints {
  std::vector<BinaryDescriptor> descriptors;
  std::vector<Eigen::Vector3d> points;  ///< [m]
  std::vector<double> sigma;            ///< standard deviation of their positions [m]
};

/// Standard deviation of the position of a keypoint [m].
/// @param point  in the sensor frame [m]
double keypoint_sigma(const Eigen::Vector3f& point, const DepthNoise& noise);

/// Keypoints of the keyframes from `first` up to `end`, in the frame of the poses.
/// @param poses  of all keyframes
PlacedKeypoints keypoints_at(const std::deque<KeyframeRecord>& records,
                             const std::vector<Eigen::Isometry3d>& poses, std::size_t first,
                             std::size_t end, const DepthNoise& noise);

/// Pairs of keypoints of a place and of a frame.
struct PlaceMatches {
  PointPairs pairs;                 ///< of the place and of the frame
  std::vector<std::size_t> frames;  ///< indices of the frame's keypoints
};

/// Keypoints of a frame that are where the place has nearly the same ones, by a pose that is
/// roughly known. Each keypoint is in one pair at most, the most similar ones first.
PlaceMatches match_at_place(const PlacedKeypoints& place, const ImageKeypoints& frame,
                            const Eigen::Isometry3d& T_place_frame, const DepthNoise& noise);

}  // namespace mms
