#pragma once

#include <chrono>
#include <deque>
#include <memory>
#include <optional>

#include "mms/server/scene/pictures.hpp"
#include "mms/server/scene/viewer_scene.hpp"

namespace mms {

/// Encodes requested images once for all viewers. Not thread-safe.
class PictureCache {
 public:
  using Clock = std::chrono::steady_clock;

  explicit PictureCache(const Scene& scene) : scene_(scene) {}

  /// The images of a frame, or of the newest or a slightly older one; null if there are none.
  std::shared_ptr<const EncodedPictures> get(std::optional<std::size_t> frame);

 private:
  struct Entry {
    Clock::time_point when;
    std::shared_ptr<const EncodedPictures> pictures;
  };

  std::shared_ptr<const EncodedPictures> kept(std::optional<std::size_t> frame) const;

  const Scene& scene_;
  std::deque<Entry> entries_;  // the latest ones
};

}  // namespace mms
