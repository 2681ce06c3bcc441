// Makes a variant of a recording of a depth camera in which it sees a part of the robot, which is
// fixed to it. usage: mms_robot_body RECORDING FOLDER SHAPE TEXTURE [FRAMES]
//   SHAPE    bumper: a plate over the lower fifth; arm: a bar from below; frame: two posts
//   TEXTURE  plain or checkered
#include <cmath>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>

#include "mms/core/random_stream.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "mms/dataset/recorder/frame_recorder.hpp"

namespace mms {
namespace {

/// [m]: noise of the depth.
constexpr float kNoise = 0.003F;
/// [-]: share of its pixels without a return.
constexpr float kHoles = 0.05F;
/// [grey levels]: noise of the colors.
constexpr float kColorNoise = 3.0F;
/// [-]: side of a checker, as a share of the image's width.
constexpr float kChecker = 0.04F;

enum class Shape { kBumper, kArm, kFrame };

Shape shape_of(const std::string& word) {
  if (word == "bumper") return Shape::kBumper;
  if (word == "arm") return Shape::kArm;
  if (word == "frame") return Shape::kFrame;
  throw std::runtime_error("SHAPE is '" + word + "', allowed: bumper, arm, frame");
}

/// Depth of the part at a pixel [m]; 0 beside it.
/// @param u, v  place in the image, in [0, 1]
float depth_at(Shape shape, float u, float v) {
  switch (shape) {
    case Shape::kBumper:
      return v > 0.8F + 0.15F * (2.0F * u - 1.0F) * (2.0F * u - 1.0F) ? 0.45F + 0.6F * (1.0F - v)
                                                                      : 0.0F;
    case Shape::kArm:
      return v > 0.4F && std::abs(u - 0.75F + 0.35F * (1.0F - v)) < 0.06F
                 ? 0.45F + 0.6F * (1.0F - v)
                 : 0.0F;
    case Shape::kFrame:
      return u < 0.09F || u > 0.91F ? 0.6F : 0.0F;
  }
  return 0.0F;
}

void add_part(Frame& frame, Shape shape, bool is_checkered, RandomStream& random) {
  const auto width = static_cast<float>(frame.depth.width());
  const auto height = static_cast<float>(frame.depth.height());
  for (int y = 0; y < frame.depth.height(); ++y) {
    for (int x = 0; x < frame.depth.width(); ++x) {
      const float u = static_cast<float>(x) / width;
      const float v = static_cast<float>(y) / height;
      const float depth = depth_at(shape, u, v);
      if (depth <= 0.0F) continue;
      frame.depth(x, y) =
          random.chance(kHoles) ? 0.0F : depth + kNoise * random.between(-1.7F, 1.7F);
      const int checker = static_cast<int>(u / kChecker) + static_cast<int>(v / kChecker);
      const float grey = is_checkered ? (checker % 2 == 0 ? 60.0F : 170.0F) : 80.0F + 30.0F * u;
      const auto value =
          static_cast<std::uint8_t>(grey + kColorNoise * random.between(-1.7F, 1.7F));
      frame.color(x, y) = {value, value, value};
      if (!frame.mask.empty()) frame.mask(x, y) = 0;
    }
  }
}

void add_robot_body(const char* recording, const char* folder, Shape shape, bool is_checkered,
                    std::size_t frames) {
  const auto source = open_dataset(recording);
  const auto recorder = record_folder(folder);
  RandomStream random(1);
  for (std::size_t i = 0; i < frames; ++i) {
    std::optional<Frame> frame = source->next();
    if (!frame) break;
    if (!frame->has_depth()) throw std::runtime_error("needs images with depth");
    add_part(*frame, shape, is_checkered, random);
    recorder->add(*frame);
  }
  recorder->finish(source->ground_truth());
}

}  // namespace
}  // namespace mms

int main(int argc, char** argv) {
  if (argc < 5 || argc > 6) {
    std::cerr
        << "usage: mms_robot_body RECORDING FOLDER bumper|arm|frame plain|checkered [FRAMES]\n";
    return 2;
  }
  try {
    const std::size_t frames =
        argc > 5 ? std::stoul(argv[5]) : std::numeric_limits<std::size_t>::max();
    mms::add_robot_body(argv[1], argv[2], mms::shape_of(argv[3]),
                        std::string(argv[4]) == "checkered", frames);
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
