#pragma once

#include <span>
#include <vector>

#include "mms/io/image/rle.hpp"

namespace mms {

/// Corners x0 y0 x1 y1 ... of a closed polygon [px]; COCO's pixel (0, 0) covers [0, 1] x [0, 1].
using Polygon = std::vector<double>;

/// The union of polygons as a mask, with the very rule of pycocotools, so that areas and overlaps
/// come out the same. Corners may lie outside the image.
/// @throws DataError when a polygon has fewer than three corners, half a corner, or a coordinate
///         that is not finite or beyond 1e6 px.
Rle rasterise(std::span<const Polygon> polygons, int width, int height);

}  // namespace mms
