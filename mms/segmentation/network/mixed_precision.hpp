#pragma once

#include <torch/types.h>

namespace mms::network {

/// During its lifetime, convolutions and matrix products of the device run in bfloat16 (torch's
/// autocast), if the device supports it: a CPU without such instructions would only convert.
class MixedPrecision {
 public:
  MixedPrecision(bool enabled, torch::DeviceType device);
  ~MixedPrecision();
  MixedPrecision(const MixedPrecision&) = delete;
  MixedPrecision& operator=(const MixedPrecision&) = delete;

  bool on() const { return on_; }

 private:
  bool on_ = false;
  torch::DeviceType device_;
};

}  // namespace mms::network
