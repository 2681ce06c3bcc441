#pragma once

#include <span>
#include <vector>

#include "mms/io/image/rle.hpp"

namespace mms {

/// Corners x0 y0 x1 y1 ... of a closed polygon [px]; COCO's pixel (0, 0) covers [0, 1] x [0, 1].
using Polygon = std::vector<double>;

/// Rasterizes the union of polygons as pycocotools does, so that areas and overlaps are equal.
/// Corners may lie outside the image.
/// @throws DataError if a polygon has fewer than three corners, an odd number of coordinates, or a
/// coordinate that is not finite or beyond 1e6 px.
Rle rasterise(std::span<const Polygon> polygons, int width, int height);

}  // namespace mms
