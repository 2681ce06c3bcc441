#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mms/core/image.hpp"
#include "mms/core/time.hpp"

namespace mms {

/// Measures how far the image moves between the frames of a recording, and how blurred it is. So it
/// finds frame rates that are too low, and exposures that are too long, for the motion.
class ImageMotion {
 public:
  /// Adds the next frame of a recording.
  /// @param begins  it does not follow the frame that was added before
  void add(Timestamp stamp, const Image<Rgb>& color, bool begins);

  /// What is wrong, each in one sentence with figures and a remedy.
  std::vector<std::string> faults() const;

 private:
  Image<float> before_;  ///< brightness at a small size
  Timestamp stamp_;
  std::vector<double> shifts_;     ///< [image widths]
  std::vector<double> intervals_;  ///< [s]
  std::vector<double> blurs_;      ///< `image_blur` at half size
};

}  // namespace mms
