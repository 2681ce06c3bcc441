#include "mms/server/scene/picture_cache.hpp"

namespace mms {
namespace {

constexpr std::size_t kEntries = 8;
/// Requests of the newest frame within this time share one encoding.
constexpr std::chrono::milliseconds kNew{50};

}  // namespace

std::shared_ptr<const EncodedPictures> PictureCache::kept(std::optional<std::size_t> frame) const {
  if (!frame) {
    const bool young = !entries_.empty() && Clock::now() - entries_.back().when < kNew;
    return young ? entries_.back().pictures : nullptr;
  }
  for (const Entry& entry : entries_) {
    if (entry.pictures->frame == *frame) return entry.pictures;
  }
  return nullptr;
}

std::shared_ptr<const EncodedPictures> PictureCache::get(std::optional<std::size_t> frame) {
  if (auto pictures = kept(frame)) return pictures;
  const std::shared_ptr<const SensorView> view = scene_.view(frame);
  if (!view) return nullptr;
  if (!frame) {
    if (auto pictures = kept(view->frame)) return pictures;
  }
  auto pictures = std::make_shared<const EncodedPictures>(encode_pictures(*view));
  entries_.push_back({Clock::now(), pictures});
  if (entries_.size() > kEntries) entries_.pop_front();
  return pictures;
}

}  // namespace mms
