#pragma once

#include <cstring>
#include <opencv2/core.hpp>

#include "mms/global_map/places/binary_descriptor.hpp"

namespace mms {

/// @param descriptors  of ORB, one a row
inline BinaryDescriptor descriptor_of(const cv::Mat& descriptors, int row) {
  BinaryDescriptor descriptor;
  std::memcpy(descriptor.words.data(), descriptors.ptr(row), sizeof(descriptor.words));
  return descriptor;
}

}  // namespace mms
