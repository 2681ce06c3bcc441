#pragma once

#include <string>

#include "mms/core/calibration.hpp"
#include "mms/core/error.hpp"
#include "mms/core/image.hpp"
#include "mms/core/size_text.hpp"

namespace mms {

/// Compares the size of an image with that of its camera. `source` says where the latter is from,
/// with its verb.
/// @throws DataError at `where`, with `hint`, for another size.
template <class T>
void check_size(const Image<T>& image, const CameraIntrinsics& camera, const std::string& where,
                const std::string& source = "the calibration has", const std::string& hint = "") {
  if (image.width() == camera.width && image.height() == camera.height) return;
  throw DataError(where,
                  "is " + size_text(image.width(), image.height()) + " pixels, " + source + " " +
                      size_text(camera.width, camera.height),
                  hint);
}

}  // namespace mms
