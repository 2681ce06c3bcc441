#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "mms/core/image.hpp"

namespace mms {

/// Potentially dynamic object classes, numbered as in mask images (value = 1 + class id) and COCO
/// results (category id = 1 + class id).
enum class ObjectClass : std::uint8_t {
  kPerson = 0,
  kAgv = 1,
  kUnknown = 2,  ///< moving object without a mask; never an output of the network
};
inline constexpr int kObjectClassCount = 2;  ///< number of classes of masks
inline constexpr int kTrackedClassCount =
    kObjectClassCount + 1;  ///< number of classes of tracked objects

/// Whether two class labels can belong to the same object: equal, or one is unknown.
constexpr bool may_be_one(ObjectClass a, ObjectClass b) {
  return a == b || a == ObjectClass::kUnknown || b == ObjectClass::kUnknown;
}

constexpr std::string_view to_string(ObjectClass object_class) {
  constexpr std::string_view kNames[kTrackedClassCount] = {"person", "agv", "unknown"};
  return kNames[static_cast<int>(object_class)];
}

/// One segmented object (C_i, M_i of III-A).
struct Instance {
  ObjectClass object_class = ObjectClass::kPerson;  ///< not kUnknown
  float score = 1.0F;                               ///< confidence in [0, 1]
  int x = 0;                                        ///< left column of `mask` in the image [px]
  int y = 0;                                        ///< top row of `mask` in the image [px]
  Image<std::uint8_t> mask;  ///< cropped to the object's box; non-zero on the object
};

/// All instances of an image of `width` x `height`. Instances may overlap; a pixel under any
/// instance is in the "dynamic state" of III-A.
struct Segmentation {
  int width = 0;                    ///< of the image [px]
  int height = 0;                   ///< of the image [px]
  std::vector<Instance> instances;  ///< in any order
};

}  // namespace mms
