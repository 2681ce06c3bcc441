#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace mms {

/// Sessions of the keyframes of a global map, numbered from 0, and which of them loops join. Those
/// that are joined share a frame; that of session 0 is the frame of the map.
class SessionGroups {
 public:
  /// Adds the next session.
  /// @param first  its first keyframe
  void add(std::size_t first);

  std::uint32_t size() const { return static_cast<std::uint32_t>(sessions_.size()); }

  /// @param keyframe  of a session that was added
  std::uint32_t session_of(std::size_t keyframe) const;

  /// First and end of the keyframes of a session.
  /// @param count  of all keyframes
  std::pair<std::size_t, std::size_t> range(std::uint32_t session, std::size_t count) const;

  /// Smallest number of the sessions that share its frame.
  std::uint32_t group_of(std::uint32_t session) const { return sessions_[session].group; }

  bool share_frame(std::uint32_t a, std::uint32_t b) const { return group_of(a) == group_of(b); }

  /// Merges the groups of two sessions. @returns whether they were different ones
  bool join(std::uint32_t a, std::uint32_t b);

 private:
  struct Session {
    std::size_t first = 0;  // keyframe
    std::uint32_t group = 0;
  };

  std::vector<Session> sessions_;
};

}  // namespace mms
