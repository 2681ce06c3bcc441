#pragma once

#include <chrono>
#include <deque>
#include <memory>
#include <optional>

#include "mms/server/scene/pictures.hpp"
#include "mms/server/scene/scene.hpp"

namespace mms {

/// Encodes the pictures that viewers ask for, once for all of them. For one thread.
class PictureCache {
 public:
  using Clock = std::chrono::steady_clock;

  explicit PictureCache(const Scene& scene) : scene_(scene) {}

  /// The pictures of a frame, or of one that is as good as the newest; null where there are none.
  std::shared_ptr<const EncodedPictures> get(std::optional<std::size_t> frame);

 private:
  struct Entry {
    Clock::time_point when;
    std::shared_ptr<const EncodedPictures> pictures;
  };

  std::shared_ptr<const EncodedPictures> kept(std::optional<std::size_t> frame) const;

  const Scene& scene_;
  std::deque<Entry> entries_;  // the last ones
};

}  // namespace mms
