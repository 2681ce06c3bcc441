#include "mms/segmentation/engine/engine_detector.hpp"

#include <omp.h>

#include <algorithm>
#include <thread>
#include <utility>

namespace mms::engine {

EngineDetector::EngineDetector(SegmentationModel model, const std::string& where,
                               Quantization quantization, const DecoderConfig& config, int threads)
    : network_(std::move(model), where, std::move(quantization)),
      config_(config),
      threads_(threads > 0 ? threads
                           : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()))) {}

std::vector<Detection> EngineDetector::detect(const Image<Rgb>& image) {
  omp_set_num_threads(
      threads_);  // OpenMP's number of threads is per thread, and frames arrive in any thread
  const PreparedImage prepared = prepare_image(image, network_.config());
  return decode(network_.run(prepared), network_.config(), prepared, config_);
}

}  // namespace mms::engine
