#pragma once

#include <filesystem>
#include <vector>

#include "mms/core/image.hpp"
#include "mms/core/time.hpp"

namespace mms::testing {

/// Whether videos can be written and read.
#if MMS_WITH_LIBAV
inline constexpr bool kHasVideo = true;
#else
inline constexpr bool kHasVideo = false;
#endif

enum class VideoCodec {
  kLossless,   ///< FFV1; every image is a key frame
  kPredicted,  ///< MPEG-4 with a key frame every fifth image, and images stored out of order
};

/// Writes images of one size at the given times [whole ms]; the container is that of the file name.
void write_video(const std::filesystem::path& path, const std::vector<Image<Rgb>>& images,
                 const std::vector<Duration>& times, VideoCodec codec);

}  // namespace mms::testing
