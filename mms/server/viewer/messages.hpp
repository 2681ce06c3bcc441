#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mms/server/scene/map_chunks.hpp"
#include "mms/server/scene/pictures.hpp"
#include "mms/server/scene/scene_data.hpp"
#include "mms/server/viewer/message.hpp"

namespace mms {

/// Version of the messages, docs/viewer_protocol.md.
inline constexpr int kProtocolVersion = 1;

/// The messages a viewer gets, each with the fields that docs/viewer_protocol.md names.
Message hello_message(const SceneInfo& info, const std::vector<std::string>& files,
                      std::string_view version);

/// Poses of successive frames. @param first  position of the first of them in the run
/// @param start  stamp of the run's first frame
Message trajectory_message(const SceneFrames& frames, std::size_t first, Timestamp start,
                           bool has_truth);
Message series_message(const SceneInfo& info, const SceneFrames& frames, std::size_t first);

/// The ways of all objects, so that they can be drawn at once. @param frames  from the run's first
Message tracks_message(const SceneFrames& frames);

/// Whether a frame's pictures are in its message, come later, or never.
enum class PicturesState { kNone, kPending, kHere };

/// What of a frame's pictures a viewer wants.
struct PictureParts {
  bool points = true;
  bool image = true;  ///< and mask

  bool any() const { return points || image; }
};

/// @param pictures  null but for PicturesState::kHere
Message frame_message(const SceneInfo& info, const SceneFrame& frame, std::size_t index,
                      PicturesState state, const EncodedPictures* pictures,
                      const PictureParts& parts = {});

/// @param points  empty: the chunk is gone
Message map_message(const VoxelKey& chunk, const LevelPoints& points);

struct PlayState {
  bool playing = false;
  std::size_t frame = 0;
  double speed = 1.0;
  bool ended = false;       ///< no frame comes after the last one there is
  std::size_t dropped = 0;  ///< frames this viewer was not sent because newer ones were there
};

/// @param files  when they have changed: the names of those that can be fetched; else empty
Message state_message(const PlayState& state, const std::vector<std::string>& files = {});

Message error_message(std::string_view text);

}  // namespace mms
