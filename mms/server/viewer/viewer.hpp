#pragma once

// Internal to server: one connected viewer, without its socket.

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "mms/server/scene/viewer_scene.hpp"
#include "mms/server/viewer/command.hpp"
#include "mms/server/viewer/map_feed.hpp"
#include "mms/server/viewer/playhead.hpp"
#include "mms/server/viewer/viewer_messages.hpp"

namespace mms {

/// Selects the next message for a viewer whenever its socket is free, so that a slow viewer gets
/// the newest data without a queue, except of short messages. Not thread-safe; slow work is
/// returned to the caller.
class Viewer {
 public:
  using Clock = std::chrono::steady_clock;
  using Pictures = std::shared_ptr<const EncodedPictures>;

  /// Encodes a message; may be called in any thread.
  using Encode = std::function<Message()>;

  Viewer(Scene& scene, std::string version);

  /// Executes a command, or queues an error. Returns whether it was valid.
  bool receive(std::string_view text, Clock::time_point now);

  /// Updates the time. To be called about 30 times per second.
  void tick(Clock::time_point now);

  /// The next message; nullopt if there is none at present.
  std::optional<Encode> next(Clock::time_point now);

  /// Whether images should be loaded, and of which frame; inner nullopt: the newest. Call `loaded`
  /// afterwards.
  std::optional<std::optional<std::size_t>> requested_pictures(Clock::time_point now);
  void loaded(Pictures pictures);

  /// Version of the map of the viewer's plan, if the map should be checked again; then call
  /// `plan_map`.
  std::optional<std::uint64_t> wants_plan(Clock::time_point now);

  /// @param map  nullopt if the version is unchanged
  void plan_map(const std::optional<std::vector<ChunkState>>& map, std::uint64_t version,
                Clock::time_point now);

 private:
  struct Sent {
    std::optional<std::size_t> frame;
    bool pictures = false;  ///< with all available ones
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
  std::vector<Timestamp> stamps_;  // of a finished run
  bool ended_ = false;
  PictureParts parts_;
  bool wants_map_ = true;

  std::size_t history_ = 0;      // frames of which all is sent at first, and at the end
  std::size_t poses_sent_ = 0;   // rows of the trajectory
  std::size_t values_sent_ = 0;  // rows of the series
  std::size_t tracks_sent_ = 0;  // frames of which the objects were sent
  bool loops_due_ = false;
  std::uint64_t edition_sent_ = 0;
  Sent sent_;
  std::size_t dropped_ = 0;

  bool loading_ = false;
  std::optional<Pictures> loaded_;  // not yet sent

  MapFeed feed_;
  bool map_turn_ = false;  // frames and chunks alternate
  bool planning_ = false;
  std::uint64_t map_version_ = 0;  // 0: plan in any case
  Clock::time_point next_plan_;
  std::optional<Eigen::Vector3f> focus_;  // given by the viewer
  Eigen::Vector3f planned_focus_ = Eigen::Vector3f::Zero();
};

}  // namespace mms
