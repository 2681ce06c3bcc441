#pragma once

#include <span>
#include <string>

#include "mms/core/object_box.hpp"
#include "mms/simulation/truth/object_truth.hpp"

namespace mms {

/// The objects of a frame for the evaluation, equal to those of read_objects_truth.
ObjectFrame object_frame(Timestamp stamp, std::span<const ObjectTruth> objects);

/// Collects the content of objects_truth.json: {"frames": [{"stamp", "objects": [...]}]}, with
/// every object of the scene in every frame. An object has "id", "label" (1 + id, its value in
/// instance images and ground-truth maps), "class", "kind", "position" [m] and "quaternion" (x y z
/// w) of its box's center in the world frame, "size" [m], "velocity" [m/s], "moving", "visible_box"
/// and "amodal_box" (x y width height [px], null if not in view), "pixels", "occlusion" and
/// "truncation".
class ObjectsTruth {
 public:
  void add(Timestamp stamp, std::span<const ObjectTruth> objects);

  /// The content of the file.
  std::string json() const;

 private:
  std::string frames_;
};

}  // namespace mms
