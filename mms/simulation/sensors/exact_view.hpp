#pragma once

#include <cstdint>

#include "mms/core/image.hpp"

namespace mms {

/// Exact rendering of a camera at one instant. All images have the camera's size.
struct ExactView {
  Image<float> depth;          ///< z of the nearest surface [m]; infinite for none
  Image<float> cosine;         ///< of the angle between ray and surface normal, in [0, 1]
  Image<float> reflectance;    ///< brightness of the material, in [0, 1]
  Image<float> gloss;          ///< specular share of the material, in [0, 1]
  Image<std::uint8_t> object;  ///< 0 static, else 1 + id of the object
};

}  // namespace mms
