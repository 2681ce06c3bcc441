#include "mms/dataset/source/first_image.hpp"

#include "mms/core/error.hpp"
#include "mms/dataset/source/depth_file.hpp"

namespace mms {
namespace {

/// What `read` returns for the first frame for which it does not throw.
template <class Read>
auto first_readable(const RgbdRecording& recording, const Read& read) {
  for (const RgbdFiles& files : recording.frames) {
    try {
      return read(files);
    } catch (const Error&) {
      continue;  // a damaged frame
    }
  }
  return read(recording.frames.front());
}

}  // namespace

Image<Rgb> first_color(const RgbdRecording& recording) {
  return first_readable(recording,
                        [&](const RgbdFiles& files) { return read_color_of(recording, files); });
}

Image<float> first_depth(const RgbdRecording& recording) {
  return first_readable(recording,
                        [](const RgbdFiles& files) { return read_depth(files.depth, 1.0, 0); });
}

}  // namespace mms
