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
  double point_size = 0.02;  ///< side of a point's square [m]; at least one pixel
  /// Omits points higher than this above the world's origin [m], such as a ceiling.
  double max_height = std::numeric_limits<double>::infinity();
};

/// Orthographic image of a cloud with hidden points removed, equal scale in x and y, on a light
/// background. It shows the central 99 % of the points in each direction, so that outliers do not
/// determine the scale. The front view omits points behind the first pose.
/// @param points  in the world frame [m]; NaN and infinite ones are ignored
/// @param colors  of the points; empty: colored by height
/// @throws DataError if the numbers of points and colors differ, or an image size is out of range
Image<Rgb> draw_map(std::span<const Eigen::Vector3f> points, std::span<const Rgb> colors,
                    const MapPictureOptions& options = {});

}  // namespace mms
