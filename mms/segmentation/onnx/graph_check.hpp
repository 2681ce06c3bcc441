#pragma once

#include <string>
#include <string_view>

namespace mms::onnx {

/// Checks that each layer of an ONNX graph takes only what the graph is given or an earlier layer
/// makes, as ONNX demands. OpenCV 4.6 crashes where one does not.
/// @param graph  the bytes of a GraphProto
/// @throws DataError at `where` naming the layer, or when the bytes are no such message.
void check_graph(std::string_view graph, const std::string& where);

}  // namespace mms::onnx
