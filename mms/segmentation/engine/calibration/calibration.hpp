#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "mms/segmentation/engine/calibration/magnitude_histogram.hpp"
#include "mms/segmentation/engine/network_engine.hpp"

namespace mms::engine {

/// Finds the ranges of a network's values on example pictures (post-training quantization).
class Calibration {
 public:
  /// @throws DataError as `NetworkEngine` does.
  Calibration(const SegmentationModel& model, const std::string& where);

  void add(const PreparedImage& image);

  /// Ranges of the least squared error.
  /// @param float_layers  convolutions to leave in float32
  /// @throws DataError when the network has no such convolution.
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

/// The network's weights as int8 convolutions take them, those that compute in bytes rounded to
/// them (`to_bytes`): a file of them is half as large and computes the same in bytes.
Weights weights_in_bytes(const SegmentationModel& model, const Quantization& quantization);

/// What it costs to compute one layer in bytes and all others in float32.
struct LayerSensitivity {
  std::string layer;
  double error = 0.0;  ///< root mean square of the head's maps' change, relative to the maps
};

/// The sensitivity of each convolution on some pictures, in the order in which they run.
/// @param progress  called with the number of layers done and of all; false stops
std::vector<LayerSensitivity> layer_sensitivities(const SegmentationModel& model,
                                                  const std::string& where,
                                                  const Quantization& quantization,
                                                  const std::vector<PreparedImage>& images,
                                                  const std::function<bool(int, int)>& progress);

/// Root mean square change of the head's maps by a quantization, relative to the maps in float32.
double output_error(const SegmentationModel& model, const std::string& where,
                    const Quantization& quantization, const std::vector<PreparedImage>& images);

}  // namespace mms::engine
