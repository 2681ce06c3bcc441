#pragma once

namespace mms::onnx {

/// One axis of a letterbox. Places are those of pixel areas: pixel i covers [i, i + 1).
struct LetterboxAxis {
  int image = 0;   ///< length of the picture [px]
  int input = 0;   ///< length of the network's input [px]
  int scaled = 0;  ///< length of the picture in the input [px]
  int offset = 0;  ///< where the picture begins in the input [px]

  /// The place in the picture of a place in the input.
  float to_image(float place) const {
    return (place - static_cast<float>(offset)) * static_cast<float>(image) /
           static_cast<float>(scaled);
  }
  /// The place in the input of a place in the picture.
  float to_input(float place) const {
    return place * static_cast<float>(scaled) / static_cast<float>(image) +
           static_cast<float>(offset);
  }
};

/// A picture of any shape in a network's input: scaled until it just fits, in the middle, with
/// padding at the two other sides.
struct Letterbox {
  LetterboxAxis x;
  LetterboxAxis y;
};

/// The letterbox as YOLO's tools make it; an odd pixel of padding is right or below.
/// All lengths are at least 1 [px].
Letterbox fit_letterbox(int image_width, int image_height, int input_width, int input_height);

}  // namespace mms::onnx
