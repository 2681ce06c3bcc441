#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mms::onnx {

/// Header data of an ONNX file.
struct ModelHeader {
  int width = 0;  ///< of the input [px]; 0: any
  int height = 0;
  std::vector<std::string> classes;  ///< from its metadata; empty if absent
};

/// Reads the header of a file: the shape of the graph's first input, and the metadata "names" of
/// YOLO tools (onnx.proto of ONNX's IR 3 to 10).
/// @throws DataError at `where` if the bytes are not an ONNX model, its graph is invalid
/// (`check_graph`), or its input is not a single color image with sides of at most 4096.
ModelHeader read_model_header(std::string_view bytes, const std::string& where);

}  // namespace mms::onnx
