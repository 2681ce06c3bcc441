#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mms::onnx {

/// What an ONNX file says of itself beside its layers.
struct ModelHeader {
  int width = 0;  ///< of the pictures that it takes [px]; 0: any
  int height = 0;
  std::vector<std::string> classes;  ///< from its metadata; empty when it names none
};

/// Reads the header of a file's bytes: the shape of the graph's first input, and what YOLO's tools
/// write into the metadata as "names" (onnx.proto of ONNX's IR 3 to 10).
/// @throws DataError at `where` when the bytes are no ONNX model, its graph is not sound
///         (`check_graph`), or it does not take a single colour picture with sides of at most 4096.
ModelHeader read_model_header(std::string_view bytes, const std::string& where);

}  // namespace mms::onnx
