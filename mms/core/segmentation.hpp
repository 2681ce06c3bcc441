#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "mms/core/image.hpp"

namespace mms {

/// The potentially dynamic object classes, numbered as in mask images (value = 1 + class id) and
/// COCO results (category id = 1 + class id).
enum class ObjectClass : std::uint8_t {
  kPerson = 0,
  kAgv = 1,
  kUnknown = 2,  ///< it moves, but no mask names it; no network and no mask gives this one
};
inline constexpr int kObjectClassCount = 2;                       ///< that masks may have
inline constexpr int kTrackedClassCount = kObjectClassCount + 1;  ///< that objects may have

/// Whether what has one class in one view may have the other in another.
constexpr bool may_be_one(ObjectClass a, ObjectClass b) {
  return a == b || a == ObjectClass::kUnknown || b == ObjectClass::kUnknown;
}

constexpr std::string_view to_string(ObjectClass object_class) {
  constexpr std::string_view kNames[kTrackedClassCount] = {"person", "agv", "unknown"};
  return kNames[static_cast<int>(object_class)];
}

/// One segmented object (C_i, M_i of the paper's III-A).
struct Instance {
  ObjectClass object_class = ObjectClass::kPerson;
  float score = 1.0F;        ///< confidence in [0, 1]
  int x = 0;                 ///< left column of `mask` in the image [px]
  int y = 0;                 ///< top row of `mask` in the image [px]
  Image<std::uint8_t> mask;  ///< cropped to the object's box: non-zero on the object
};

/// All instances of one image of `width` x `height`. Instances may overlap; a pixel under any of
/// them is in the "dynamic state" of III-A.
struct Segmentation {
  int width = 0;
  int height = 0;
  std::vector<Instance> instances;
};

}  // namespace mms
