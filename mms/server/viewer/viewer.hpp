#pragma once

// Internal to server: one connected viewer, apart from its socket.

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "mms/server/scene/scene.hpp"
#include "mms/server/viewer/command.hpp"
#include "mms/server/viewer/map_feed.hpp"
#include "mms/server/viewer/messages.hpp"
#include "mms/server/viewer/playhead.hpp"

namespace mms {

/// What a viewer is to be sent next, decided when its socket is free: so that a slow viewer is sent
/// the newest of everything and nothing waits in line but short messages. For one thread; what
/// takes time is given to the caller to be done elsewhere.
class Viewer {
 public:
  using Clock = std::chrono::steady_clock;
  using Pictures = std::shared_ptr<const EncodedPictures>;

  /// Makes a message; may be called in any thread.
  using Encode = std::function<Message()>;

  Viewer(Scene& scene, std::string version);

  /// Obeys a command, or answers with an error. Returns whether it was one.
  bool receive(std::string_view text, Clock::time_point now);

  /// Goes with the time. To be called some 30 times a second.
  void tick(Clock::time_point now);

  /// What to send next; nothing when there is nothing now.
  std::optional<Encode> next(Clock::time_point now);

  /// Whether pictures are to be loaded now, and of which frame; nothing in the inner: the newest.
  /// `loaded` is to be called when that is done.
  std::optional<std::optional<std::size_t>> wanted_pictures(Clock::time_point now);
  void loaded(Pictures pictures);

  /// The map's version that this viewer has planned for, when it is to be looked at again;
  /// `plan_map` is then to be called.
  std::optional<std::uint64_t> wants_plan(Clock::time_point now);

  /// @param map  nothing where it is of that version still
  void plan_map(const std::optional<std::vector<ChunkState>>& map, std::uint64_t version,
                Clock::time_point now);

 private:
  struct Sent {
    std::optional<std::size_t> frame;
    bool pictures = false;  ///< with all there are
    Clock::time_point when;
  };

  void obey(const Command& command, Clock::time_point now);
  void obey(const WantCommand& want);
  void notice_end();
  std::optional<Encode> next_short();
  bool wants_pictures() const { return parts_.any() && scene_.info().has_pictures; }
  std::optional<Encode> next_history();
  std::optional<Encode> next_frame(Clock::time_point now);
  std::optional<Encode> next_chunk(Clock::time_point now);
  Encode send_frame(std::size_t index, PicturesState state, Pictures pictures,
                    Clock::time_point now);
  Eigen::Vector3f focus() const;

  Scene& scene_;
  std::string version_;
  bool hello_due_ = true;
  std::deque<Message> errors_;
  bool state_due_ = true;
  bool files_due_ = false;
  Playhead playhead_;
  std::vector<Timestamp> stamps_;  // of an ended run
  bool ended_ = false;
  PictureParts parts_;
  bool wants_map_ = true;

  std::size_t poses_sent_ = 0;   // rows of the trajectory
  std::size_t values_sent_ = 0;  // rows of the series
  bool tracks_due_ = true;
  std::uint64_t edition_sent_ = 0;
  Sent sent_;
  std::size_t dropped_ = 0;

  bool loading_ = false;
  std::optional<Pictures> loaded_;  // not yet sent

  MapFeed feed_;
  bool map_turn_ = false;  // frames and chunks take turns
  bool planning_ = false;
  std::uint64_t map_version_ = 0;  // 0: plan in any case
  Clock::time_point next_plan_;
  std::optional<Eigen::Vector3f> focus_;  // as the viewer said
  Eigen::Vector3f planned_focus_ = Eigen::Vector3f::Zero();
};

}  // namespace mms
