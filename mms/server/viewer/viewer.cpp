#include "mms/server/viewer/viewer.hpp"

#include <algorithm>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/server/scene/downloads.hpp"

namespace mms {
namespace {

constexpr std::chrono::milliseconds kLivePeriod{66};   ///< between frames of a live run
constexpr std::chrono::milliseconds kPlanPeriod{500};  ///< between plans of the map
constexpr std::size_t kDefaultBudget = 5'000'000;      ///< points of the map
/// Frames in a message of history, so that its size does not grow with a run.
constexpr std::size_t kHistoryPart = 4096;
constexpr std::size_t kMaxErrors = 8;  ///< pending messages
constexpr float kFocusMoved = 2.0F;    ///< [m]

}  // namespace

Viewer::Viewer(Scene& scene, std::string version)
    : scene_(scene),
      version_(std::move(version)),
      loops_due_(!scene.loops().empty()),
      edition_sent_(scene.edition()),
      feed_(kDefaultBudget) {}

bool Viewer::receive(std::string_view text, Clock::time_point now) {
  try {
    obey(parse_command(text), now);
    tick(now);  // keeps the playhead within the run
    return true;
  } catch (const Error& error) {
    if (errors_.size() < kMaxErrors) errors_.push_back(error_message(error.what()));
    return false;
  }
}

void Viewer::obey(const Command& command, Clock::time_point now) {
  state_due_ = true;
  if (std::holds_alternative<PlayCommand>(command)) playhead_.play(now);
  if (std::holds_alternative<PauseCommand>(command)) {
    // Of a newer frame than the displayed one there may be no pictures any more.
    if (playhead_.follows() && sent_.frame) playhead_.seek(*sent_.frame);
    playhead_.pause();
  }
  if (const auto* step = std::get_if<StepCommand>(&command)) playhead_.step(step->by);
  if (const auto* seek = std::get_if<SeekCommand>(&command)) playhead_.seek(seek->frame);
  if (const auto* speed = std::get_if<SpeedCommand>(&command)) {
    playhead_.set_speed(speed->value, now);
  }
  if (const auto* want = std::get_if<WantCommand>(&command)) obey(*want);
  if (const auto* focus = std::get_if<FocusCommand>(&command)) focus_ = focus->point;
}

void Viewer::obey(const WantCommand& want) {
  const PictureParts before = parts_;
  parts_.points = want.points.value_or(parts_.points);
  parts_.image = want.image.value_or(parts_.image);
  if (parts_ != before) sent_.pictures = false;
  if (want.map.value_or(wants_map_) != wants_map_ || want.budget) map_version_ = 0;
  wants_map_ = want.map.value_or(wants_map_);
  if (want.budget) feed_.set_budget(*want.budget);
}

void Viewer::tick(Clock::time_point now) {
  notice_end();
  const bool was_playing = playhead_.playing();
  ended_ ? playhead_.advance(stamps_, now) : playhead_.follow(scene_.size());
  state_due_ = state_due_ || playhead_.playing() != was_playing;
}

void Viewer::notice_end() {
  if (ended_ || !scene_.ended()) return;
  ended_ = true;
  stamps_ = scene_.stamps();
  state_due_ = true;
  files_due_ = !hello_due_;
  tracks_sent_ = 0;
  values_sent_ = 0;  // distances of corrected poses
  loops_due_ = !scene_.loops().empty();
}

std::optional<Viewer::Encode> Viewer::next(Clock::time_point now) {
  if (scene_.size() == 0 && !ended_) return std::nullopt;  // the sensor is not yet known
  if (auto task = next_short()) return task;
  if (edition_sent_ != scene_.edition()) {
    edition_sent_ = scene_.edition();
    poses_sent_ = 0;
    tracks_sent_ -= std::min(tracks_sent_, kHistoryPart);  // their trails are drawn
    sent_ = {};
    loops_due_ = !scene_.loops().empty();
  }
  if (auto task = next_history()) return task;
  map_turn_ = !map_turn_;
  if (map_turn_) {
    if (auto task = next_chunk(now)) return task;
  }
  if (auto task = next_frame(now)) return task;
  return map_turn_ ? std::nullopt : next_chunk(now);
}

std::optional<Viewer::Encode> Viewer::next_short() {
  if (std::exchange(hello_due_, false)) {
    return [&scene = scene_, version = version_] {
      SceneInfo info = scene.info();
      if (info.live && scene.ended()) {
        info.live = false;
        info.frames = scene.size();
      }
      return hello_message(info, download_names(scene), version);
    };
  }
  if (!errors_.empty()) {
    Message message = std::move(errors_.front());
    errors_.pop_front();
    return [message] { return message; };
  }
  if (!state_due_) return std::nullopt;
  state_due_ = false;
  const PlayState state{playhead_.playing(), playhead_.frame(), playhead_.speed(),
                        playhead_.ended(), dropped_};
  const bool with_files = std::exchange(files_due_, false);
  return [&scene = scene_, state, with_files] {
    return state_message(state, with_files ? download_names(scene) : std::vector<std::string>{});
  };
}

/// Unsent rows before the current frame; all of them at first and at the end.
std::optional<Viewer::Encode> Viewer::next_history() {
  Scene& scene = scene_;
  if (ended_ || poses_sent_ == 0) history_ = scene.size();
  const std::size_t last = std::max(history_, playhead_.frame());
  const auto next_part = [](std::size_t& sent, std::size_t end) {
    return std::exchange(sent, std::min(end, sent + kHistoryPart));
  };
  if (poses_sent_ < last) {
    const std::size_t first = next_part(poses_sent_, last);
    return [&scene, first, end = poses_sent_] { return trajectory_message(scene, first, end); };
  }
  if (values_sent_ < last) {
    const std::size_t first = next_part(values_sent_, last);
    return [&scene, first, end = values_sent_] { return series_message(scene, first, end); };
  }
  if (tracks_sent_ < history_) {
    const std::size_t first = next_part(tracks_sent_, history_);
    return [&scene, first, end = tracks_sent_] { return tracks_message(scene, first, end); };
  }
  if (std::exchange(loops_due_, false)) {
    return [&scene] { return loops_message(scene.loops()); };
  }
  return std::nullopt;
}

std::optional<Viewer::Encode> Viewer::next_frame(Clock::time_point now) {
  if (scene_.size() == 0) return std::nullopt;
  const std::size_t index = playhead_.frame();
  if (loaded_) {
    const Pictures pictures = *std::exchange(loaded_, std::nullopt);
    if (!pictures) return send_frame(index, PicturesState::kNone, nullptr, now);
    if (playhead_.playing() || pictures->frame == index) {
      return send_frame(pictures->frame, PicturesState::kHere, pictures, now);
    }
  }
  const bool waits = wants_pictures() && playhead_.playing() && sent_.frame;
  if (sent_.frame == index || waits) return std::nullopt;
  return send_frame(index, wants_pictures() ? PicturesState::kPending : PicturesState::kNone,
                    nullptr, now);
}

Viewer::Encode Viewer::send_frame(std::size_t index, PicturesState state, Pictures pictures,
                                  Clock::time_point now) {
  if (playhead_.playing() && sent_.frame && index > *sent_.frame + 1) {
    dropped_ += index - *sent_.frame - 1;
  }
  sent_ = {index, state != PicturesState::kPending, now};
  if (poses_sent_ == index) poses_sent_ = index + 1;
  if (values_sent_ == index) values_sent_ = index + 1;
  return [&scene = scene_, index, state, parts = parts_, pictures = std::move(pictures)] {
    return frame_message(scene.info(), scene.frame(index), index, state, pictures.get(), parts);
  };
}

std::optional<std::optional<std::size_t>> Viewer::requested_pictures(Clock::time_point now) {
  if (loading_ || loaded_ || !wants_pictures() || scene_.size() == 0) return std::nullopt;
  const std::size_t index = playhead_.frame();
  if (sent_.frame == index && sent_.pictures) return std::nullopt;
  const bool follows = !ended_ && playhead_.follows();
  if (follows && now - sent_.when < kLivePeriod) return std::nullopt;
  loading_ = true;
  return follows ? std::optional<std::size_t>() : index;
}

void Viewer::loaded(Pictures pictures) {
  loading_ = false;
  loaded_ = std::move(pictures);
}

std::optional<std::uint64_t> Viewer::wants_plan(Clock::time_point now) {
  if (!wants_map_ || planning_ || now < next_plan_) return std::nullopt;
  planning_ = true;
  const bool moved = (focus() - planned_focus_).norm() > kFocusMoved;
  return moved || feed_.deferred() ? 0 : map_version_;
}

void Viewer::plan_map(const std::optional<std::vector<ChunkState>>& map, std::uint64_t version,
                      Clock::time_point now) {
  planning_ = false;
  next_plan_ = now + kPlanPeriod;
  if (!map) return;
  map_version_ = version;
  planned_focus_ = focus();
  feed_.plan(*map, planned_focus_, now);
}

std::optional<Viewer::Encode> Viewer::next_chunk(Clock::time_point now) {
  if (!wants_map_) return std::nullopt;
  const std::optional<ChunkTask> task = feed_.next(now);
  if (!task) return std::nullopt;
  return [&scene = scene_, task = *task] {
    return map_message(task.key, scene.read_map([&](const MapChunks& map) {
      return map.points(task.key, task.level);
    }));
  };
}

/// The viewer's focus, by default the sensor's position.
Eigen::Vector3f Viewer::focus() const {
  if (focus_) return *focus_;
  try {
    if (scene_.size() > 0) {
      return scene_.frame(playhead_.frame()).T_world_sensor.translation().cast<float>();
    }
  } catch (const Error&) {  // of the disk: the viewer goes on
  }
  return Eigen::Vector3f::Zero();
}

}  // namespace mms
