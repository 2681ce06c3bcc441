#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "mms/global_map/places/binary_descriptor.hpp"
#include "mms/global_map/places/descriptor_forest.hpp"

namespace mms {

/// A keyframe that may show the same place.
struct PlaceCandidate {
  std::size_t keyframe = 0;  ///< its number
  double score = 0.0;        ///< sum of the weights of the descriptors found
};

/// Finds earlier keyframes that show the same place by their descriptors. Descriptors that are
/// found in many keyframes count less, as words in text retrieval do (inverse document frequency).
class PlaceRecognizer {
 public:
  using IsUsable = std::function<bool(std::size_t keyframe)>;

  /// Adds the next keyframe; the first one is number 0.
  void add(const std::vector<BinaryDescriptor>& descriptors);

  /// @param descriptors  of the keyframe that is searched for
  /// @param end          only keyframes with smaller numbers are found
  /// @param max_count    of candidates
  /// @param is_usable    whether a keyframe may be a candidate
  /// @returns the candidates by falling score, of a group of successive keyframes the best one
  std::vector<PlaceCandidate> find(const std::vector<BinaryDescriptor>& descriptors,
                                   std::size_t end, std::size_t max_count,
                                   const IsUsable& is_usable = any) const;

  std::size_t size() const { return keyframes_; }  ///< number of keyframes

 private:
  static bool any(std::size_t) { return true; }

  DescriptorForest forest_;
  std::vector<std::uint32_t> keyframe_of_;  ///< by id of the descriptor
  std::size_t keyframes_ = 0;
};

}  // namespace mms
