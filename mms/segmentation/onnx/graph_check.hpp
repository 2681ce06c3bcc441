#pragma once

#include <string>
#include <string_view>

namespace mms::onnx {

/// Checks that the layers of an ONNX graph only use inputs of the graph and results of earlier
/// layers, as ONNX requires; OpenCV 4.6 crashes otherwise.
/// @param graph  the bytes of a GraphProto
/// @throws DataError at `where` with the layer, or if the bytes are not such a message.
void check_graph(std::string_view graph, const std::string& where);

}  // namespace mms::onnx
