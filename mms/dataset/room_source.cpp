#include "mms/dataset/room_source.hpp"

#include <algorithm>
#include <string>

#include "mms/io/numbers.hpp"

namespace mms {
namespace {

class RoomSource final : public FrameSource {
 public:
  RoomSource(const RoomConfig& config, bool load_masks) : room_(config), load_masks_(load_masks) {
    for (int i = 0; i < room_.size(); ++i) truth_.push_back(room_.truth(i));
  }

  std::optional<Frame> next() override {
    if (position_ >= size()) return std::nullopt;
    Frame frame = room_.render(static_cast<int>(position_++));
    if (!load_masks_) frame.mask = {};
    return frame;
  }

  std::size_t size() const override { return static_cast<std::size_t>(room_.size()); }
  std::size_t skipped() const override { return 0; }
  bool has_masks() const override { return load_masks_; }
  void skip(std::size_t count) override { position_ += std::min(count, size() - position_); }
  const Trajectory& ground_truth() const override { return truth_; }
  void on_warning(WarningHandler) override {}

  std::vector<std::string> describe() const override {
    const RoomConfig& config = room_.config();
    return {"format: simulated room, seed " + std::to_string(config.seed),
            "frames: " + std::to_string(config.frames) + " at " + format_number(config.hz) + " Hz",
            "image: " + std::to_string(config.width) + " x " + std::to_string(config.height) +
                " with depth",
            "moving objects: " + std::to_string(room_.objects(0).size()),
            load_masks_ ? "masks: exact" : "masks: none",
            "truth: exact"};
  }

 private:
  SimulatedRoom room_;
  bool load_masks_;
  Trajectory truth_;
  std::size_t position_ = 0;
};

}  // namespace

std::unique_ptr<FrameSource> play_room(const RoomConfig& config, bool load_masks) {
  return std::make_unique<RoomSource>(config, load_masks);
}

}  // namespace mms
