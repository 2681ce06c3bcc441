#include "mms/segmentation/weights/layer_shapes.hpp"

namespace mms {

std::size_t value_count(const TensorShape& shape) {
  std::size_t count = 1;
  for (const std::int64_t side : shape) count *= static_cast<std::size_t>(side);
  return count;
}

std::string shape_text(const TensorShape& shape) {
  std::string text = "(";
  for (const std::int64_t side : shape) {
    text += (text.size() == 1 ? "" : ", ") + std::to_string(side);
  }
  return text + ")";
}

void LayerShapes::add(const std::string& name, TensorShape shape) {
  shapes_[name] = std::move(shape);
}

void LayerShapes::conv(const std::string& name, std::int64_t out, std::int64_t in,
                       std::int64_t side) {
  add(name + ".weight", {out, in, side, side});
}

void LayerShapes::biased_conv(const std::string& name, std::int64_t out, std::int64_t in,
                              std::int64_t side) {
  conv(name, out, in, side);
  add(name + ".bias", {out});
}

void LayerShapes::group_norm(const std::string& name, std::int64_t channels) {
  for (const char* part : {".weight", ".bias"}) add(name + part, {channels});
}

void LayerShapes::batch_norm(const std::string& name, std::int64_t channels, std::int64_t levels) {
  group_norm(name, channels);
  const TensorShape shape = levels > 0 ? TensorShape{levels, channels} : TensorShape{channels};
  for (const char* part : {".running_mean", ".running_var"}) add(name + part, shape);
}

}  // namespace mms
