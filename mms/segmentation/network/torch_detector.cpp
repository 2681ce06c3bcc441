#include "mms/segmentation/network/torch_detector.hpp"

#include <ATen/Parallel.h>
#include <torch/cuda.h>

#include <algorithm>
#include <thread>

#include "mms/segmentation/network/inference.hpp"

namespace mms::network {

bool has_gpu() {
  return torch::cuda::is_available();
}

TorchDetector::TorchDetector(const SegmentationModel& model, const std::string& where,
                             const DecoderConfig& config, int threads)
    : network_(model.network), classes_(model.classes), config_(config) {
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  at::set_num_threads(threads > 0 ? threads : cores);
  load_weights(*network_, model.weights, where);
  network_->eval();
  network_->fold();
  put_channels_last(*network_);
  if (has_gpu()) network_->to(torch::kCUDA);
}

std::vector<Detection> TorchDetector::detect(const Image<Rgb>& image) {
  at::init_num_threads();  // torch's number of threads is per thread, and frames arrive in any
                           // thread
  return network::detect(network_, image, config_);
}

}  // namespace mms::network
