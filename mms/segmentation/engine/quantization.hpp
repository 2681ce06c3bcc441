#pragma once

#include <map>
#include <set>
#include <string>

#include "mms/core/weights.hpp"
#include "mms/segmentation/engine/graph/graph.hpp"

namespace mms::engine {

/// How a network is to compute in bytes. Weights are symmetric per output channel, maps symmetric
/// as a whole (unsigned where they are not negative).
struct Quantization {
  std::map<std::string, float> ranges;  ///< of a value: the largest magnitude that is kept
  std::set<std::string> float_layers;   ///< convolutions that stay in float32
};

/// Writes how a network is quantized into the metadata of its weights.
void pack_quantization(const Quantization& quantization, Weights& weights);

/// Reads what `pack_quantization` wrote; no ranges where it wrote nothing.
/// @throws DataError at `where` for a range that is no positive number.
Quantization unpack_quantization(const Weights& weights, const std::string& where);

/// @throws DataError at `where` unless there are ranges of all values of the graph and of no other,
/// or none at all.
void check_quantization(const Quantization& quantization, const Graph& graph,
                        const std::string& where);

/// The graph with the formats of its values chosen, and conversions where they change. A
/// convolution is quantized when the range of its input is known and it is no float layer.
Graph quantized(const Graph& graph, const Quantization& quantization);

}  // namespace mms::engine
