#include "mms/dataset/camera/camera_choice.hpp"

#include <algorithm>

#include "mms/core/error.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {

std::size_t chosen_camera(const std::string& address, const std::string& which,
                          const std::vector<std::string>& uris) {
  if (which.empty()) return 0;
  if (const auto index = parse_integer(which)) {
    if (*index >= 0 && static_cast<std::size_t>(*index) < uris.size()) {
      return static_cast<std::size_t>(*index);
    }
    throw DataError(address,
                    uris.size() == 1
                        ? "the only camera has the index 0"
                        : "the indices of the cameras are 0 to " + std::to_string(uris.size() - 1),
                    "mms cameras lists them");
  }
  const auto found = std::find(uris.begin(), uris.end(), which);
  if (found == uris.end()) {
    throw DataError(address, "no camera has this URI", "mms cameras lists them");
  }
  return static_cast<std::size_t>(found - uris.begin());
}

}  // namespace mms
