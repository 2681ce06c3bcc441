#include "tests/segmentation/tiny_onnx.hpp"

#include <vector>

#include "tests/segmentation/protobuf_writer.hpp"

namespace mms::testing {
namespace {

using Shape = std::vector<std::int64_t>;

constexpr int kCells = 8;  // per side
constexpr int kCount = kCells * kCells;

// Field numbers of onnx.proto.
constexpr std::uint64_t kNode = 1;         // of a graph
constexpr std::uint64_t kInitializer = 5;  // of a graph
constexpr std::uint64_t kInput = 11;       // of a graph
constexpr std::uint64_t kOutput = 12;      // of a graph
constexpr std::uint64_t kFloat32 = 1;      // data type
constexpr std::uint64_t kInt64 = 7;        // data type
constexpr std::uint64_t kInts = 7;         // attribute type

template <class Number>
std::string tensor(const std::string& name, std::uint64_t type, const Shape& shape,
                   const std::vector<Number>& values) {
  ProtobufWriter writer;
  for (const std::int64_t length : shape) writer.number(1, static_cast<std::uint64_t>(length));
  writer.number(2, type).bytes(8, name);
  writer.bytes(9, {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Number)});
  return writer.message();
}

std::string floats(const std::string& name, const Shape& shape, const std::vector<float>& values) {
  return tensor(name, kFloat32, shape, values);
}

std::string ints(const std::string& name, const Shape& values) {
  return tensor(name, kInt64, {static_cast<std::int64_t>(values.size())}, values);
}

std::string ints_attribute(const std::string& name, const Shape& values) {
  ProtobufWriter writer;
  writer.bytes(1, name);
  for (const std::int64_t value : values) writer.number(8, static_cast<std::uint64_t>(value));
  return writer.number(20, kInts).message();
}

std::string axis_attribute(int axis) {
  constexpr std::uint64_t kInt = 2;
  return ProtobufWriter()
      .bytes(1, "axis")
      .number(3, static_cast<std::uint64_t>(axis))
      .number(20, kInt)
      .message();
}

std::string node(const std::string& type, const std::vector<std::string>& inputs,
                 const std::string& output, const std::vector<std::string>& attributes = {}) {
  ProtobufWriter writer;
  for (const std::string& input : inputs) writer.bytes(1, input);
  writer.bytes(2, output).bytes(3, output + "_node").bytes(4, type);
  for (const std::string& attribute : attributes) writer.bytes(5, attribute);
  return writer.message();
}

std::string value_info(const std::string& name, const Shape& shape) {
  ProtobufWriter dimensions;
  for (const std::int64_t length : shape) {
    ProtobufWriter dimension;
    if (length != 0) dimension.number(1, static_cast<std::uint64_t>(length));
    if (length == 0) dimension.bytes(2, "any");
    dimensions.bytes(1, dimension.message());
  }
  const std::string type =
      ProtobufWriter().number(1, kFloat32).bytes(2, dimensions.message()).message();
  const std::string holder = ProtobufWriter().bytes(1, type).message();
  return ProtobufWriter().bytes(1, name).bytes(2, holder).message();
}

/// Weights of a convolution over squares of side x side px: factors of each output channel for the
/// mean of red, green and blue.
std::vector<float> mean_weights(const std::vector<std::vector<float>>& colors, int side) {
  std::vector<float> weights;
  for (const std::vector<float>& color : colors) {
    for (const float weight : color) {
      weights.insert(weights.end(), static_cast<std::size_t>(side * side),
                     weight / static_cast<float>(side * side));
    }
  }
  return weights;
}

void add_convolution(ProtobufWriter& graph, const std::string& output, int side,
                     const std::vector<std::vector<float>>& colors,
                     const std::vector<float>& bias) {
  const auto channels = static_cast<std::int64_t>(bias.size());
  graph.bytes(kInitializer,
              floats(output + "_w", {channels, 3, side, side}, mean_weights(colors, side)));
  graph.bytes(kInitializer, floats(output + "_b", {channels}, bias));
  graph.bytes(kNode, node("Conv", {"images", output + "_w", output + "_b"}, output,
                          {ints_attribute("kernel_shape", {side, side}),
                           ints_attribute("strides", {side, side})}));
}

/// A reshape to a row of cells per channel.
void add_rows(ProtobufWriter& graph, const std::string& input, const std::string& output,
              std::int64_t channels) {
  graph.bytes(kInitializer, ints(output + "_shape", {1, channels, kCount}));
  graph.bytes(kNode, node("Reshape", {input, output + "_shape"}, output));
}

/// "boxes": center and size, first in cells, then in pixels by the factor (1, cells) as in YOLOv8.
void add_boxes(ProtobufWriter& graph) {
  const std::vector<float> none(3, 0.0F);
  add_convolution(graph, "sizes", 8, {none, none, none, none}, {0.5F, 0.5F, 4.0F, 4.0F});
  add_rows(graph, "sizes", "size_rows", 4);
  std::vector<float> corners(4 * kCount, 0.0F);
  for (std::size_t i = 0; i < kCount; ++i) {
    corners[i] = static_cast<float>(i % kCells);
    corners[kCount + i] = static_cast<float>(i / kCells);
  }
  graph.bytes(kInitializer, floats("corners", {1, 4, kCount}, corners));
  graph.bytes(kInitializer, floats("strides", {1, kCount}, std::vector<float>(kCount, 8.0F)));
  graph.bytes(kNode, node("Add", {"corners", "size_rows"}, "cell_boxes"));
  graph.bytes(kNode, node("Mul", {"cell_boxes", "strides"}, "boxes"));
}

/// "rows": the boxes, then, cell by cell, classes and the mask's two coefficients.
void add_predictions(ProtobufWriter& graph, bool objectness) {
  std::vector<std::vector<float>> colors = {{0.9F, -0.9F, 0.0F}, {0.0F, -0.9F, 0.9F}};
  std::vector<float> bias = {0.0F, 0.0F, 1.0F, -2.0F};
  colors.resize(4, {0.0F, 0.0F, 0.0F});
  if (objectness) {
    colors.insert(colors.begin(), {0.0F, 0.0F, 0.0F});
    bias.insert(bias.begin(), 0.5F);
  }
  add_boxes(graph);
  add_convolution(graph, "cells", 8, colors, bias);
  add_rows(graph, "cells", "cell_rows", static_cast<std::int64_t>(bias.size()));
  graph.bytes(kNode, node("Concat", {"boxes", "cell_rows"}, "rows", {axis_attribute(1)}));
}

std::string graph_of(const TinyOnnx& model) {
  const bool columns = model.format == onnx::YoloFormat::kV5;
  ProtobufWriter graph;
  add_predictions(graph, columns);
  if (columns) {
    graph.bytes(kNode,
                node("Transpose", {"rows"}, "transposed", {ints_attribute("perm", {0, 2, 1})}));
  }
  graph.bytes(kNode, node(model.last, {columns ? "transposed" : "rows"}, "output0"));
  if (model.prototypes) {
    add_convolution(graph, "output1", 4, {{24.0F, -48.0F, 24.0F}, {0.0F, 0.0F, 0.0F}},
                    {-10.0F, 1.0F});
  }
  graph.bytes(2, "tiny");
  graph.bytes(kInput, value_info("images", {model.batch, model.channels, model.side, model.side}));
  const int values = columns ? 9 : 8;
  graph.bytes(kOutput,
              value_info("output0", columns ? Shape{1, kCount, values} : Shape{1, values, kCount}));
  if (model.prototypes) graph.bytes(kOutput, value_info("output1", {1, 2, 16, 16}));
  return graph.message();
}

}  // namespace

std::string tiny_onnx(const TinyOnnx& model) {
  constexpr std::uint64_t kIrVersion = 7;
  constexpr std::uint64_t kOperators = 12;
  const std::string entry = ProtobufWriter().bytes(1, "names").bytes(2, model.names).message();
  return ProtobufWriter()
      .number(1, kIrVersion)
      .bytes(2, "mms")
      .bytes(7, graph_of(model))
      .bytes(8, ProtobufWriter().bytes(1, "").number(2, kOperators).message())
      .bytes(14, ProtobufWriter().bytes(1, "task").bytes(2, "segment").message())
      .bytes(14, entry)
      .message();
}

}  // namespace mms::testing
