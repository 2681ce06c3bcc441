#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>

#include "mms/core/image.hpp"
#include "mms/report/view_axes.hpp"

namespace mms {

struct MapPictureOptions {
  int width = 960;   ///< [px], 1 to kMaxImageSide
  int height = 720;  ///< [px], 1 to kMaxImageSide
  Viewpoint viewpoint = Viewpoint::kTop;
  UpAxis up = UpAxis::kNegativeY;
  double point_size = 0.02;  ///< edge of the square drawn for a point [m]; at least one pixel
  /// Points higher over the world's origin than this [m] are left out: a ceiling hides the room.
  double max_height = std::numeric_limits<double>::infinity();
};

/// Orthographic picture of a cloud, nearest point in front, one metre equally long in x and y, on a
/// light background. The view fits the center 99 % of the points in each direction, so that a few
/// strays do not shrink it. The front view leaves out what lies behind the first pose.
/// @param points  in the world frame [m]; NaN and infinite ones are ignored
/// @param colors  of the points; empty: coloured by height
/// @throws DataError when the sizes of points and colors differ, or a picture size is out of range
Image<Rgb> draw_map(std::span<const Eigen::Vector3f> points, std::span<const Rgb> colors,
                    const MapPictureOptions& options = {});

}  // namespace mms
