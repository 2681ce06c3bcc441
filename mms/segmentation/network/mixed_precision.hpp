#pragma once

#include <torch/types.h>

namespace mms::network {

/// While one lives, convolutions and matrix products of the device run in bfloat16 where that is
/// sound (torch's autocast) and the device computes in it: without such instructions a CPU would
/// only convert to and fro.
class MixedPrecision {
 public:
  MixedPrecision(bool wanted, torch::DeviceType device);
  ~MixedPrecision();
  MixedPrecision(const MixedPrecision&) = delete;
  MixedPrecision& operator=(const MixedPrecision&) = delete;

  bool on() const { return on_; }

 private:
  bool on_ = false;
  torch::DeviceType device_;
};

}  // namespace mms::network
