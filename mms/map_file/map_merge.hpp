#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "mms/global_map/global_map.hpp"
#include "mms/map_file/map_file.hpp"

namespace mms {

/// Joins maps at the places that they share. The order of the maps does not matter. Sessions that
/// several maps have, as those that continue one map, are taken from the earliest.
class MapMerge {
 public:
  /// Called for each keyframe: done, all.
  using ProgressHandler = std::function<void(std::size_t, std::size_t)>;

  /// @throws Error if a file is no map; DataError if two are the same map
  /// @param warn  called for each damaged part that is left out
  MapMerge(const std::vector<std::filesystem::path>& maps, const MapFile::WarningHandler& warn);

  /// Finds loops between the maps.
  /// @param map  without keyframes
  /// @returns the sessions that are joined to the first one, of `sessions`
  std::size_t join(GlobalMap& map, const ProgressHandler& progress);

  std::size_t sessions() const { return sessions_; }

  /// The map whose frame is that of all: that of the earliest session.
  const MapFile& first() const { return *parts_.front().file; }
  const std::filesystem::path& first_path() const { return parts_.front().path; }

  /// Writes all sessions to a new file.
  /// @param map  of `join`
  void write(const std::filesystem::path& path, const GlobalMap& map,
             const MapFile::WarningHandler& warn) const;

 private:
  struct Part {
    std::filesystem::path path;
    std::unique_ptr<MapFile> file;
    GlobalMapContent content;
    std::uint64_t digest = 0;            // of the keyframes
    std::vector<std::uint32_t> numbers;  // of its sessions in the joined map
  };

  void add(Part& part, GlobalMap& map, const std::function<void()>& progress) const;

  std::vector<Part> parts_;  // in an order that their content alone decides
  std::size_t sessions_ = 0;
};

}  // namespace mms
