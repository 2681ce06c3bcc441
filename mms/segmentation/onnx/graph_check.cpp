#include "mms/segmentation/onnx/graph_check.hpp"

#include <unordered_set>

#include "mms/core/error.hpp"
#include "mms/segmentation/onnx/protobuf_reader.hpp"

namespace mms::onnx {
namespace {

// Field numbers of onnx.proto.
constexpr std::uint64_t kGraphNode = 1;
constexpr std::uint64_t kGraphInitializer = 5;
constexpr std::uint64_t kGraphInput = 11;
constexpr std::uint64_t kTensorName = 8;
constexpr std::uint64_t kInputName = 1;
constexpr std::uint64_t kNodeInput = 1;
constexpr std::uint64_t kNodeOutput = 2;
constexpr std::uint64_t kNodeOperator = 4;

using Names = std::unordered_set<std::string_view>;

/// Calls `action` with the bytes of each field of that number.
template <class Action>
void for_each(std::string_view message, std::uint64_t number, const std::string& where,
              const Action& action) {
  ProtobufReader reader(message, where);
  while (const auto field = reader.next()) {
    if (field->number == number) action(field->bytes);
  }
}

/// Inputs of the graph; the empty name is an omitted input.
Names given_names(std::string_view graph, const std::string& where) {
  Names names = {""};
  const auto collect = [&](std::uint64_t field, std::uint64_t name) {
    for_each(graph, field, where, [&](std::string_view item) {
      for_each(item, name, where, [&](std::string_view text) { names.insert(text); });
    });
  };
  collect(kGraphInput, kInputName);
  collect(kGraphInitializer, kTensorName);
  return names;
}

[[noreturn]] void fail(std::string_view node, std::string_view input, const std::string& where) {
  std::string type = "a layer";
  for_each(node, kNodeOperator, where, [&](std::string_view text) { type = text; });
  throw DataError(where,
                  "has a layer " + type + " with the input '" + std::string(input) +
                      "', which no earlier layer computes",
                  "export it again");
}

}  // namespace

void check_graph(std::string_view graph, const std::string& where) {
  Names known = given_names(graph, where);
  for_each(graph, kGraphNode, where, [&](std::string_view node) {
    for_each(node, kNodeInput, where, [&](std::string_view input) {
      if (!known.contains(input)) fail(node, input, where);
    });
    for_each(node, kNodeOutput, where, [&](std::string_view output) { known.insert(output); });
  });
}

}  // namespace mms::onnx
