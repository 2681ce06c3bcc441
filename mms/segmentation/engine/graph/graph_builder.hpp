#pragma once

#include <map>
#include <string>
#include <vector>

#include "mms/segmentation/engine/graph/graph.hpp"

namespace mms::engine {

/// Appends operations to a graph and computes their shapes.
class GraphBuilder {
 public:
  static constexpr ValueId kNone = -1;

  explicit GraphBuilder(const Shape& input);

  ValueId convolution(const ConvLayerPtr& layer, ValueId x, ValueId residual = kNone);
  ValueId max_pooling(const MaxPooling& pooling, ValueId x);
  ValueId resized(bool bilinear, ValueId x, int height, int width, ValueId addend = kNone);
  ValueId concatenation(const std::vector<ValueId>& parts);
  ValueId constant(const Shape& shape, std::vector<float> values, const std::string& name);
  ValueId global_context(GlobalContext context, ValueId x, ValueId residual = kNone);
  ValueId gate(Gate gate, ValueId x);
  ValueId blending(ValueId a, ValueId b, ValueId gate);
  ValueId global_branch(const ConvLayerPtr& layer, ValueId x);
  ValueId group_norm(GroupNorm norm, ValueId x);

  ValueId input() const { return graph_.input; }
  const Shape& shape(ValueId id) const { return graph_.value(id).shape; }
  Graph finish(const GraphOutputs& outputs);

 private:
  ValueId append(Operation operation, std::vector<ValueId> inputs, const std::string& name,
                 const Shape& shape, bool non_negative);
  bool non_negative(const std::vector<ValueId>& ids) const;

  Graph graph_;
  std::map<std::string, int> names_;  ///< number of values with each name
};

}  // namespace mms::engine
