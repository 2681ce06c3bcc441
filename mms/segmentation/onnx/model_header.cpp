#include "mms/segmentation/onnx/model_header.hpp"

#include <initializer_list>
#include <optional>

#include "mms/core/error.hpp"
#include "mms/segmentation/onnx/class_names.hpp"
#include "mms/segmentation/onnx/graph_check.hpp"
#include "mms/segmentation/onnx/protobuf_reader.hpp"

namespace mms::onnx {
namespace {

// Field numbers of onnx.proto.
constexpr std::uint64_t kModelGraph = 7;
constexpr std::uint64_t kModelMetadata = 14;
constexpr std::uint64_t kGraphInput = 11;
constexpr std::uint64_t kInputType = 2;
constexpr std::uint64_t kTypeTensor = 1;
constexpr std::uint64_t kTensorShape = 2;
constexpr std::uint64_t kShapeDimension = 1;
constexpr std::uint64_t kDimensionValue = 1;
constexpr std::uint64_t kEntryKey = 1;
constexpr std::uint64_t kEntryValue = 2;

constexpr std::uint64_t kMaxSide = 4096;

/// The first field of that number in a message.
std::optional<ProtobufField> find(std::string_view message, std::uint64_t number,
                                  const std::string& where) {
  ProtobufReader reader(message, where);
  while (const auto field = reader.next()) {
    if (field->number == number) return field;
  }
  return std::nullopt;
}

/// The nested message at a path of field numbers; empty if there is none.
std::string_view nested(std::string_view message, std::initializer_list<std::uint64_t> path,
                        const std::string& where) {
  for (const std::uint64_t number : path) {
    const auto field = find(message, number, where);
    message = field ? field->bytes : std::string_view();
  }
  return message;
}

/// Lengths of a tensor's axes; 0 if unspecified.
std::vector<std::uint64_t> dimensions(std::string_view shape, const std::string& where) {
  std::vector<std::uint64_t> lengths;
  ProtobufReader reader(shape, where);
  while (const auto field = reader.next()) {
    if (field->number != kShapeDimension) continue;
    const auto value = find(field->bytes, kDimensionValue, where);
    lengths.push_back(value ? value->value : 0);
  }
  return lengths;
}

void read_input(std::string_view graph, ModelHeader& header, const std::string& where) {
  const std::string_view shape =
      nested(graph, {kGraphInput, kInputType, kTypeTensor, kTensorShape}, where);
  const std::vector<std::uint64_t> lengths = dimensions(shape, where);
  const bool picture = lengths.size() == 4 && lengths[0] <= 1 &&
                       (lengths[1] == 3 || lengths[1] == 0) && lengths[2] <= kMaxSide &&
                       lengths[3] <= kMaxSide;
  if (picture) {
    header.height = static_cast<int>(lengths[2]);
    header.width = static_cast<int>(lengths[3]);
    return;
  }
  std::string found;
  for (const std::uint64_t length : lengths) {
    found += (found.empty() ? "" : ", ") + (length == 0 ? "any" : std::to_string(length));
  }
  throw DataError(where, "has an input of shape (" + found +
                             "), expected (1, 3, height, width) with sides of at most " +
                             std::to_string(kMaxSide));
}

void read_metadata(std::string_view entry, ModelHeader& header, const std::string& where) {
  if (nested(entry, {kEntryKey}, where) != "names") return;
  header.classes = python_names(nested(entry, {kEntryValue}, where));
}

}  // namespace

ModelHeader read_model_header(std::string_view bytes, const std::string& where) {
  ModelHeader header;
  bool graph = false;
  ProtobufReader model(bytes, where);
  while (const auto field = model.next()) {
    if (field->number == kModelMetadata) read_metadata(field->bytes, header, where);
    if (field->number != kModelGraph) continue;
    check_graph(field->bytes, where);
    read_input(field->bytes, header, where);
    graph = true;
  }
  if (!graph) throw DataError(where, "is not an ONNX model: it has no graph");
  return header;
}

}  // namespace mms::onnx
