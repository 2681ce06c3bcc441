#include "mms/map_file/map_merge.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/map_file/map_composition.hpp"

namespace mms {
namespace {

constexpr const char* kScans = "LiDAR scans";
constexpr const char* kImages = "depth images";

constexpr std::uint64_t kDigestBasis = 14695981039346656037U;

/// FNV-1a.
void add_to(std::uint64_t& digest, std::uint64_t value) {
  constexpr std::uint64_t kPrime = 1099511628211U;
  digest = (digest ^ value) * kPrime;
}

/// Over stamps and descriptors, which differ from map to map.
std::uint64_t digest_of(const GlobalMapContent& content) {
  std::uint64_t digest = kDigestBasis;
  for (const KeyframeRecord& record : content.records) {
    add_to(digest, static_cast<std::uint64_t>(record.stamp.nanoseconds()));
    for (const BinaryDescriptor& descriptor : record.keypoints.descriptors) {
      for (const std::uint64_t word : descriptor.words) add_to(digest, word);
    }
  }
  return digest;
}

/// FNV-1a over the stamps of each session, and over the features of its first keyframe: maps that
/// continue one map have its sessions, with fewer views.
std::vector<std::uint64_t> session_digests(const GlobalMapContent& content) {
  std::vector<std::uint64_t> digests;
  for (const KeyframeRecord& record : content.records) {
    const bool is_first = record.session == digests.size();
    if (is_first) digests.push_back(kDigestBasis);
    add_to(digests.back(), static_cast<std::uint64_t>(record.stamp.nanoseconds()));
    if (!is_first) continue;
    add_to(digests.back(), record.features.edges.size());
    add_to(digests.back(), record.features.planes.size());
    for (const BinaryDescriptor& descriptor : record.keypoints.descriptors) {
      for (const std::uint64_t word : descriptor.words) add_to(digests.back(), word);
    }
  }
  return digests;
}

/// Accepted loops of a map, by keyframe, with its numbers.
std::vector<std::vector<Loop>> accepted_loops(const GlobalMapContent& content) {
  std::vector<std::vector<Loop>> loops(content.records.size());
  for (const Loop& loop : content.loops) {
    if (loop.outcome == LoopOutcome::kAccepted) loops[loop.query].push_back(loop);
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
    parts_.push_back(std::move(part));
  }
  std::sort(parts_.begin(), parts_.end(), [](const Part& a, const Part& b) {
    const auto key = [](const Part& part) {
      return std::pair(part.file->sessions().front().begin, part.digest);
    };
    return key(a) < key(b);
  });
  std::vector<std::uint64_t> known;
  for (Part& part : parts_) {
    const bool is_first = known.empty();
    for (const std::uint64_t digest : session_digests(part.content)) {
      const auto found = is_first ? known.end() : std::find(known.begin(), known.end(), digest);
      part.numbers.push_back(static_cast<std::uint32_t>(found - known.begin()));
      if (found == known.end()) known.push_back(digest);
    }
  }
  sessions_ = known.size();
}

std::size_t MapMerge::join(GlobalMap& map, const ProgressHandler& progress) {
  std::size_t all = 0;
  for (const Part& part : parts_) all += part.content.records.size();
  std::size_t done = parts_.front().content.records.size();
  map.restore(std::move(parts_.front().content), MapUse::kExtend);
  for (std::size_t i = 1; i < parts_.size(); ++i) {
    add(parts_[i], map, [&] { progress(++done, all); });
  }
  map.finish();
  std::size_t joined = 0;
  for (std::uint32_t i = 0; i < sessions_; ++i) joined += map.is_joined(i) ? 1 : 0;
  return joined;
}

/// Adds the sessions that no map before has. Loops to and between them are searched; those that
/// alone relate sessions, as after a loss of the sensor, are taken.
void MapMerge::add(Part& part, GlobalMap& map, const std::function<void()>& progress) const {
  std::deque<KeyframeRecord>& records = part.content.records;
  const std::vector<std::vector<Loop>> loops = accepted_loops(part.content);
  std::vector<std::size_t> places;  // of its keyframes in the joined map
  const auto placed = [&](Loop loop) {
    loop.candidate = places[loop.candidate];
    loop.query = places[loop.query];
    return loop;
  };
  std::optional<std::uint32_t> session;  // of the keyframe in this part
  std::uint32_t number = 0;              // in the joined map
  bool is_known = false;
  std::size_t place = 0;
  for (std::size_t k = 0; k < records.size(); ++k, ++place) {
    if (session != records[k].session) {
      session = records[k].session;
      number = part.numbers[*session];
      is_known = number <= map.records().back().session;
      const auto first =
          std::find_if(map.records().begin(), map.records().end(),
                       [number](const KeyframeRecord& known) { return known.session == number; });
      place = static_cast<std::size_t>(first - map.records().begin());
    }
    places.push_back(place);
    if (!is_known) {
      KeyframeRecord record = std::move(records[k]);
      record.session = number;
      std::vector<Loop> known;
      if (record.is_pose_only()) {
        std::transform(loops[k].begin(), loops[k].end(), std::back_inserter(known), placed);
      }
      map.add(std::move(record), std::nullopt, known);
    }
    progress();
  }
  for (const std::vector<Loop>& of_keyframe : loops) {
    for (const Loop& loop : of_keyframe) {
      const Loop own = placed(loop);
      if (!map.share_frame(map.records()[own.candidate].session,
                           map.records()[own.query].session)) {
        map.join({own});
      }
    }
  }
}

void MapMerge::write(const std::filesystem::path& path, const GlobalMap& map,
                     const MapFile::WarningHandler& warn) const {
  MapFile file(path, MapFile::Mode::kCreate);
  for (const Part& part : parts_) {
    for (std::uint32_t i = 0; i < part.file->sessions().size(); ++i) {
      if (part.numbers[i] < file.sessions().size()) continue;  // of a map before
      file.add_session(part.file->sessions()[i], part.file->surfaces(i, warn), map.records());
    }
  }
  file.set_graph(map.poses(), map.loops());
  file.commit();
}

}  // namespace mms
