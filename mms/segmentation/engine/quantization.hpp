#pragma once

#include <map>
#include <set>
#include <string>

#include "mms/core/weights.hpp"
#include "mms/segmentation/engine/graph/graph.hpp"

namespace mms::engine {

/// Settings of int8 inference. Weights are symmetric per output channel, maps symmetric as a whole
/// (unsigned if not negative).
struct Quantization {
  std::map<std::string, float> ranges;  ///< of a value: the clipping magnitude
  std::set<std::string> float_layers;   ///< convolutions that stay in float32
};

/// Writes the quantization to the metadata of the weights.
void pack_quantization(const Quantization& quantization, Weights& weights);

/// Reads the result of `pack_quantization`; no ranges if there is none.
/// @throws DataError at `where` for a range that is not a positive number.
Quantization unpack_quantization(const Weights& weights, const std::string& where);

/// @throws DataError at `where` unless there are ranges for exactly the values of the graph, or
/// none at all.
void check_quantization(const Quantization& quantization, const Graph& graph,
                        const std::string& where);

/// The graph with the formats of its values, and conversions where formats change. A convolution is
/// quantized if the range of its input is known and it is not a float layer.
Graph quantized(const Graph& graph, const Quantization& quantization);

}  // namespace mms::engine
