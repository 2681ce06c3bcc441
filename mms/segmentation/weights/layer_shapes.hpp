#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace mms {

using TensorShape = std::vector<std::int64_t>;
using TensorShapes = std::map<std::string, TensorShape>;  ///< by the tensor's name

/// Numbers in a tensor: the product of its sides.
std::size_t value_count(const TensorShape& shape);

/// "(64, 3, 7, 7)", for messages.
std::string shape_text(const TensorShape& shape);

/// Collects the tensors of a network's layers. Convolutions are square: (out, in, side, side).
class LayerShapes {
 public:
  void add(const std::string& name, TensorShape shape);
  void conv(const std::string& name, std::int64_t out, std::int64_t in, std::int64_t side);
  void biased_conv(const std::string& name, std::int64_t out, std::int64_t in, std::int64_t side);
  /// Weight and bias.
  void group_norm(const std::string& name, std::int64_t channels);
  /// Weight, bias and the statistics.
  /// @param levels  with statistics of their own; 0: one for all
  void batch_norm(const std::string& name, std::int64_t channels, std::int64_t levels = 0);

  const TensorShapes& shapes() const { return shapes_; }

 private:
  TensorShapes shapes_;
};

}  // namespace mms
