#include "mms/segmentation/network/mixed_precision.hpp"

#include <ATen/autocast_mode.h>
#include <torch/version.h>

namespace mms::network {
namespace {

// torch 2 has the device as an argument, torch 1 a function per device.
void switch_autocast(torch::DeviceType device, bool on) {
#if TORCH_VERSION_MAJOR >= 2
  at::autocast::set_autocast_enabled(device, on);
  at::autocast::set_autocast_dtype(device, torch::kBFloat16);
#else
  if (device == torch::kCUDA) {
    at::autocast::set_enabled(on);
    at::autocast::set_autocast_gpu_dtype(torch::kBFloat16);
  } else {
    at::autocast::set_cpu_enabled(on);
    at::autocast::set_autocast_cpu_dtype(torch::kBFloat16);
  }
#endif
}

bool cpu_computes_in_bfloat16() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx512bf16");
#else
  return false;
#endif
}

}  // namespace

MixedPrecision::MixedPrecision(bool enabled, torch::DeviceType device)
    : on_(enabled && (device != torch::kCPU || cpu_computes_in_bfloat16())), device_(device) {
  if (on_) switch_autocast(device_, true);
}

MixedPrecision::~MixedPrecision() {
  if (!on_) return;
  switch_autocast(device_, false);
  at::autocast::clear_cache();
}

}  // namespace mms::network
