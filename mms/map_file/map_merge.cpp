#include "mms/map_file/map_merge.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/map_file/map_composition.hpp"

namespace mms {
namespace {

constexpr const char* kScans = "LiDAR scans";
constexpr const char* kImages = "depth images";

/// FNV-1a over stamps and descriptors, which differ from map to map.
std::uint64_t digest_of(const GlobalMapContent& content) {
  constexpr std::uint64_t kPrime = 1099511628211U;
  std::uint64_t digest = 14695981039346656037U;
  const auto add = [&](std::uint64_t value) { digest = (digest ^ value) * kPrime; };
  for (const KeyframeRecord& record : content.records) {
    add(static_cast<std::uint64_t>(record.stamp.nanoseconds()));
    for (const BinaryDescriptor& descriptor : record.keypoints.descriptors) {
      for (const std::uint64_t word : descriptor.words) add(word);
    }
  }
  return digest;
}

/// Accepted loops of the keyframes of which only the pose is kept, by keyframe.
/// @param offset  number of the first keyframe in the joined map
std::vector<std::vector<Loop>> loops_of_poses(const GlobalMapContent& content, std::size_t offset) {
  std::vector<std::vector<Loop>> loops(content.records.size());
  for (Loop loop : content.loops) {
    const std::size_t query = loop.query;
    if (loop.outcome != LoopOutcome::kAccepted || !content.records[query].is_pose_only()) continue;
    loop.candidate += offset;
    loop.query += offset;
    loops[query].push_back(std::move(loop));
  }
  return loops;
}

}  // namespace

MapMerge::MapMerge(const std::vector<std::filesystem::path>& maps,
                   const MapFile::WarningHandler& warn) {
  for (const std::filesystem::path& path : maps) {
    Part part;
    part.path = path;
    part.file = std::make_unique<MapFile>(path, MapFile::Mode::kRead);
    part.content = part.file->content(warn);  // has a session
    part.digest = digest_of(part.content);
    const auto same = std::find_if(parts_.begin(), parts_.end(),
                                   [&](const Part& p) { return p.digest == part.digest; });
    if (same != parts_.end()) throw DataError(path.string(), "is given twice, or is a copy");
    const bool is_mixed = !parts_.empty() && has_scans(part.content, 0) &&
                          has_scans(parts_.front().content, 0) &&
                          has_scans(part.content, 0) != has_scans(parts_.front().content, 0);
    if (is_mixed) {
      throw DataError(
          path.string(),
          fmt::format("is a map of {}, but {} is one of {}",
                      *has_scans(part.content, 0) ? kScans : kImages, maps.front().string(),
                      *has_scans(part.content, 0) ? kImages : kScans),
          "merge maps of the same sensor");
    }
    sessions_ += part.file->sessions().size();
    parts_.push_back(std::move(part));
  }
  std::sort(parts_.begin(), parts_.end(), [](const Part& a, const Part& b) {
    const auto key = [](const Part& part) {
      return std::pair(part.file->sessions().front().begin, part.digest);
    };
    return key(a) < key(b);
  });
}

std::size_t MapMerge::join(GlobalMap& map, const ProgressHandler& progress) {
  std::size_t all = 0;
  for (const Part& part : parts_) all += part.content.records.size();
  std::size_t done = parts_.front().content.records.size();
  auto session = static_cast<std::uint32_t>(parts_.front().file->sessions().size());
  map.restore(std::move(parts_.front().content), MapUse::kExtend);
  for (std::size_t i = 1; i < parts_.size(); ++i) {
    const std::uint32_t first = session;
    session += static_cast<std::uint32_t>(parts_[i].file->sessions().size());
    GlobalMapContent& content = parts_[i].content;
    std::vector<std::vector<Loop>> known = loops_of_poses(content, map.records().size());
    for (std::size_t k = 0; k < content.records.size(); ++k) {
      content.records[k].session += first;
      map.add(std::move(content.records[k]), std::nullopt, known[k]);
      progress(++done, all);
    }
  }
  map.finish();
  std::size_t joined = 0;
  for (std::uint32_t i = 0; i < session; ++i) joined += map.is_joined(i) ? 1 : 0;
  return joined;
}

void MapMerge::write(const std::filesystem::path& path, const GlobalMap& map,
                     const MapFile::WarningHandler& warn) const {
  MapFile file(path, MapFile::Mode::kCreate);
  for (const Part& part : parts_) {
    for (std::uint32_t i = 0; i < part.file->sessions().size(); ++i) {
      file.add_session(part.file->sessions()[i], part.file->surfaces(i, warn), map.records());
    }
  }
  file.set_graph(map.poses(), map.loops());
  file.commit();
}

}  // namespace mms
