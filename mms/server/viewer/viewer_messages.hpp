#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mms/server/scene/map_chunks.hpp"
#include "mms/server/scene/pictures.hpp"
#include "mms/server/scene/viewer_scene.hpp"
#include "mms/server/viewer/message.hpp"

namespace mms {

/// Protocol version, docs/viewer_protocol.md.
inline constexpr int kProtocolVersion = 1;

/// Messages to a viewer, with the fields of docs/viewer_protocol.md.
Message hello_message(const SceneInfo& info, const std::vector<std::string>& files,
                      std::string_view version);

/// Poses of the frames in [first, last).
/// @throws FileError if the scene's frames cannot be read; also those below
Message trajectory_message(const Scene& scene, std::size_t first, std::size_t last);
Message series_message(const Scene& scene, std::size_t first, std::size_t last);

/// Objects in the frames in [first, last), for drawing their trajectories.
Message tracks_message(const Scene& scene, std::size_t first, std::size_t last);

/// Loops between frames.
Message loops_message(const std::vector<SceneLoop>& loops);

/// Whether a frame's images are in its message, follow later, or do not exist.
enum class PicturesState { kNone, kPending, kHere };

/// Which of a frame's images a viewer requests.
struct PictureParts {
  bool points = true;
  bool image = true;  ///< and mask

  bool any() const { return points || image; }
  bool operator==(const PictureParts&) const = default;
};

/// @param pictures  null unless PicturesState::kHere
Message frame_message(const SceneInfo& info, const SceneFrame& frame, std::size_t index,
                      PicturesState state, const EncodedPictures* pictures,
                      const PictureParts& parts = {});

/// @param points  empty: the chunk was removed
Message map_message(const VoxelKey& chunk, const LevelPoints& points);

struct PlayState {
  bool playing = false;
  std::size_t frame = 0;
  double speed = 1.0;
  bool ended = false;       ///< no further frames follow
  std::size_t dropped = 0;  ///< frames skipped because newer ones were available
};

/// @param files  names of the downloadable files if they changed; else empty
Message state_message(const PlayState& state, const std::vector<std::string>& files = {});

Message error_message(std::string_view text);

}  // namespace mms
