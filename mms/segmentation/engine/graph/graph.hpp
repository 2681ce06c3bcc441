#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "mms/segmentation/engine/graph/conv_layer.hpp"
#include "mms/segmentation/solo/network_config.hpp"

namespace mms::engine {

/// Shape of a map of one image; maps are dense, channels last.
struct Shape {
  int height = 0;
  int width = 0;
  int channels = 0;

  int pixels() const { return height * width; }
  int count() const { return height * width * channels; }
  bool operator==(const Shape&) const = default;
};

enum class Number { kFloat, kSigned8, kUnsigned8 };

/// Number format of a map: value = stored * scale.
struct Format {
  Number number = Number::kFloat;
  float scale = 1.0F;

  bool operator==(const Format&) const = default;
  int bytes() const { return number == Number::kFloat ? 4 : 1; }
};

/// Index of a value in its graph.
using ValueId = int;

/// A map: result of one operation and input of others.
struct Value {
  std::string name;  ///< name of its operation, unique
  Shape shape;
  bool non_negative = false;
  bool keep_float = false;  ///< not to be quantized
  Format format{};
};

/// y = conv(x) (+ residual) (ReLU). Inputs: x, and the residual if any.
struct Convolution {
  ConvLayerPtr layer;
};

/// Maximum of kernel x kernel pixels.
struct MaxPooling {
  int kernel = 1;
  int stride = 1;
  int padding = 0;
};

/// Resizes x to the output's size, as libtorch with align_corners = false. Inputs: x, and
/// optionally a map to add.
struct Resizing {
  bool bilinear = false;
};

/// Concatenates the inputs' channels.
struct Concatenation {};

/// A map that does not depend on the image.
struct Constant {
  std::vector<float> values;
};

/// y = scale (x + W mean(x) + b) + shift (+ residual) (ReLU): the global context of switchable
/// atrous convolution with the following batch norm, if any. Inputs: x, and the residual if any.
struct GlobalContext {
  ConvLayerPtr layer;        ///< 1x1: W, b
  std::vector<float> scale;  ///< per channel
  std::vector<float> shift;
  bool relu = false;
};

/// One channel w . x + b, averaged over box x box pixels (mirrored at the boundary) at every
/// stride-th pixel, optionally with a sigmoid: the switch of SAC, the weight of RFP's fusion.
struct Gate {
  std::vector<float> weight;
  float bias = 0.0F;
  int box = 1;
  int stride = 1;
  bool sigmoid = false;
};

/// gate a + (1 - gate) b. Inputs: a, b, gate.
struct Blending {};

/// relu(W mean(x) + b) at all pixels: the global branch of ASPP.
struct GlobalBranch {
  ConvLayerPtr layer;
};

/// Group norm and ReLU.
struct GroupNorm {
  int groups = 1;
  std::vector<float> gamma;
  std::vector<float> beta;
};

/// Converts to the output's format.
struct Conversion {};

using Operation = std::variant<Convolution, MaxPooling, Resizing, Concatenation, Constant,
                               GlobalContext, Gate, Blending, GlobalBranch, GroupNorm, Conversion>;

struct Node {
  Operation operation;
  std::vector<ValueId> inputs;
  ValueId output = 0;
};

/// The head's maps.
struct GraphOutputs {
  std::array<ValueId, HeadConfig::kLevels> categories{};
  std::array<ValueId, HeadConfig::kLevels> kernels{};
  ValueId mask_features = 0;

  template <typename Function>
  void for_each(Function&& function) {
    for (ValueId& id : categories) function(id);
    for (ValueId& id : kernels) function(id);
    function(mask_features);
  }
};

/// A network for inputs of one size: operations in the order of execution.
struct Graph {
  std::vector<Value> values;
  std::vector<Node> nodes;
  ValueId input = 0;  ///< height x width x 3, normalized by `prepare_image`
  GraphOutputs outputs;

  Value& value(ValueId id) { return values[static_cast<std::size_t>(id)]; }
  const Value& value(ValueId id) const { return values[static_cast<std::size_t>(id)]; }
};

}  // namespace mms::engine
