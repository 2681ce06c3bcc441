#pragma once

#include <cstdint>

#include "mms/core/image.hpp"

namespace mms {

/// What every pixel of a camera sees, exactly and at one instant. All images of the camera's size.
struct ExactView {
  Image<float> depth;          ///< z of the nearest surface [m]; infinite for none
  Image<float> cosine;         ///< of the angle between ray and surface normal, in [0, 1]
  Image<float> reflectance;    ///< how bright the material is, in [0, 1]
  Image<float> gloss;          ///< how much of the light it mirrors, in [0, 1]
  Image<std::uint8_t> object;  ///< 0 static, else 1 + id of the object
};

}  // namespace mms
