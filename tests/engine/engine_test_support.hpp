#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "mms/segmentation/engine/tensor.hpp"
#include "mms/segmentation/solo/prepared_image.hpp"
#include "mms/segmentation/weights/model.hpp"
#include "mms/segmentation/weights/tensor_shapes.hpp"

namespace mms::testing {

inline std::vector<float> random_numbers(std::size_t count, float deviation, unsigned seed,
                                         float mean = 0.0F) {
  std::mt19937 generator(seed);
  std::normal_distribution<float> normal(mean, deviation);
  std::vector<float> values(count);
  for (float& value : values) value = normal(generator);
  return values;
}

/// A tensor that owns its memory.
struct OwnTensor {
  OwnTensor(const engine::Shape& shape, const engine::Format& format = {})
      : memory(static_cast<std::size_t>(shape.count()) * sizeof(float) + engine_alignment),
        tensor{shape, format, aligned()} {}
  OwnTensor(const engine::Shape& shape, const std::vector<float>& values,
            const engine::Format& format = {})
      : OwnTensor(shape, format) {
    engine::store(tensor, {0, shape.pixels()}, values.data());
  }
  OwnTensor(const OwnTensor&) = delete;
  OwnTensor& operator=(const OwnTensor&) = delete;

  std::vector<float> values() const {
    std::vector<float> all(static_cast<std::size_t>(tensor.shape.count()));
    engine::load(tensor, {0, tensor.shape.pixels()}, all.data());
    return all;
  }
  float at(int y, int x, int channel) const {
    const engine::Shape& s = tensor.shape;
    return values()[static_cast<std::size_t>((y * s.width + x) * s.channels + channel)];
  }

  static constexpr std::size_t engine_alignment = 64;
  std::vector<std::byte> memory;
  engine::Tensor tensor;

 private:
  std::byte* aligned() {
    void* start = memory.data();
    std::size_t space = memory.size();
    return static_cast<std::byte*>(std::align(engine_alignment, 1, start, space));
  }
};

/// Standard deviation of a convolution's weights that keeps the magnitude of maps.
inline float fitting_deviation(const TensorShape& shape) {
  return std::sqrt(1.5F / static_cast<float>(shape[1] * shape[2] * shape[3]));
}

/// A network with random weights.
inline SegmentationModel random_model(const NetworkConfig& config, unsigned seed) {
  SegmentationModel model{config, {"person", "agv"}, {}};
  const TensorShapes shapes = expected_tensors(config);
  for (const auto& [name, shape] : shapes) {
    WeightTensor& tensor = model.weights.tensors[name] = {shape, {}};
    const std::size_t count = value_count(shape);
    ++seed;
    if (name.ends_with("running_var")) {
      tensor.values.assign(count, 1.0F);
    } else if (name.ends_with("weight_beta")) {
      tensor.values.assign(count, 0.0F);
    } else if (name.ends_with("weight_gamma")) {
      const std::string weight = name.substr(0, name.size() - std::string("_gamma").size());
      tensor.values.assign(count, fitting_deviation(shapes.at(weight)));
    } else if (name.ends_with("switch.bias")) {
      tensor.values.assign(count, 0.8F);
    } else if (name.find("switch") != std::string::npos || name.ends_with("weight_diff") ||
               name.find("context") != std::string::npos) {
      tensor.values = random_numbers(count, 0.01F, seed);
    } else if (shape.size() == 4) {
      tensor.values = random_numbers(count, fitting_deviation(shape), seed);
    } else if (name.ends_with("weight")) {
      tensor.values = random_numbers(count, 0.1F, seed, 1.0F);
    } else {
      tensor.values = random_numbers(count, 0.1F, seed);
    }
  }
  return model;
}

inline PreparedImage random_image(int height, int width, unsigned seed) {
  return {.planes = random_numbers(static_cast<std::size_t>(3 * height * width), 1.0F, seed),
          .width = width,
          .height = height,
          .valid_width = width,
          .valid_height = height,
          .image_width = width,
          .image_height = height};
}

}  // namespace mms::testing
