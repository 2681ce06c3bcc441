#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "mms/segmentation/engine/calibration/magnitude_histogram.hpp"
#include "mms/segmentation/engine/network_engine.hpp"

namespace mms::engine {

/// Determines the ranges of a network's values on example images (post-training quantization).
class Calibration {
 public:
  /// @throws DataError as `NetworkEngine`.
  Calibration(const SegmentationModel& model, const std::string& where);

  void add(const PreparedImage& image);

  /// Ranges with the least squared error.
  /// @param float_layers  convolutions that stay in float32
  /// @throws DataError if the network has no such convolution.
  Quantization quantization(std::set<std::string> float_layers) const;

  const NetworkConfig& config() const { return network_.config(); }

 private:
  struct Seen {
    bool non_negative = false;
    MagnitudeHistogram histogram;
  };

  std::string where_;
  NetworkEngine network_;
  std::map<std::string, Seen> values_;
};

/// The network's weights with those of int8 convolutions rounded (`to_bytes`): the file has half
/// the size and gives the same int8 results.
Weights weights_in_bytes(const SegmentationModel& model, const Quantization& quantization);

/// Error from computing one layer in int8 and all others in float32.
struct LayerSensitivity {
  std::string layer;
  double error = 0.0;  ///< relative RMS change of the head's maps
};

/// The sensitivity of each convolution on example images, in the order of execution.
/// @param progress  called with the number of finished layers and the total; returning false stops
std::vector<LayerSensitivity> layer_sensitivities(const SegmentationModel& model,
                                                  const std::string& where,
                                                  const Quantization& quantization,
                                                  const std::vector<PreparedImage>& images,
                                                  const std::function<bool(int, int)>& progress);

/// Relative RMS change of the head's maps by a quantization, compared to float32.
double output_error(const SegmentationModel& model, const std::string& where,
                    const Quantization& quantization, const std::vector<PreparedImage>& images);

}  // namespace mms::engine
