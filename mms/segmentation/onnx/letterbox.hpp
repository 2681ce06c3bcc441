#pragma once

namespace mms::onnx {

/// One axis of a letterbox. Positions refer to pixel areas: pixel i covers [i, i + 1).
struct LetterboxAxis {
  int image = 0;   ///< length of the image [px]
  int input = 0;   ///< length of the network's input [px]
  int scaled = 0;  ///< length of the scaled image [px]
  int offset = 0;  ///< start of the scaled image in the input [px]

  /// Converts a position from input to image.
  float to_image(float place) const {
    return (place - static_cast<float>(offset)) * static_cast<float>(image) /
           static_cast<float>(scaled);
  }
  /// Converts a position from image to input.
  float to_input(float place) const {
    return place * static_cast<float>(scaled) / static_cast<float>(image) +
           static_cast<float>(offset);
  }
};

/// An image fitted into a network's input: scaled with constant aspect ratio, centered, padded on
/// two sides.
struct Letterbox {
  LetterboxAxis x;
  LetterboxAxis y;
};

/// The letterbox of YOLO tools; an odd pixel of padding is at the right or bottom. All lengths are
/// at least 1 [px].
Letterbox fit_letterbox(int image_width, int image_height, int input_width, int input_height);

}  // namespace mms::onnx
