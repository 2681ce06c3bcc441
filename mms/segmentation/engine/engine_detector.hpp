#pragma once

#include <string>
#include <vector>

#include "mms/segmentation/detection/detector.hpp"
#include "mms/segmentation/engine/network_engine.hpp"

namespace mms::engine {

/// Detects objects with a `NetworkEngine`.
class EngineDetector : public Detector {
 public:
  /// @param where    name of the model in messages, such as the file name
  /// @param threads  of the network; 0: one per core
  /// @throws DataError as `NetworkEngine`.
  EngineDetector(SegmentationModel model, const std::string& where, Quantization quantization,
                 const DecoderConfig& config, int threads);

  std::vector<Detection> detect(const Image<Rgb>& image) override;
  const std::vector<std::string>& classes() const override { return network_.classes(); }

 private:
  NetworkEngine network_;
  DecoderConfig config_;
  int threads_;
};

}  // namespace mms::engine
