#include "mms/segmentation/onnx/yolo_decoder.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "mms/segmentation/onnx/yolo_boxes.hpp"
#include "mms/segmentation/onnx/yolo_mask.hpp"

namespace mms::onnx {
namespace {

constexpr int kSide = 64;  // of the input
constexpr int kMask = 16;  // of the prototypes
constexpr float kCertain = 30.0F;

/// One proposed object of two classes with two coefficients.
struct Proposal {
  std::array<float, 4> box = {32, 32, 16, 16};  ///< center, size
  std::array<float, 2> classes = {0.9F, 0.0F};
  std::array<float, 2> coefficients = {1.0F, 0.0F};
  float objectness = 1.0F;  ///< YOLOv5 only
};

/// A model's outputs with their owner.
struct Outputs {
  YoloLayout layout;
  std::vector<float> predictions;
  std::vector<float> prototypes = std::vector<float>(2 * kMask * kMask, kCertain);

  std::vector<Detection> decode(const Letterbox& letterbox, const OnnxConfig& config = {}) const {
    return decode_yolo({predictions.data(), prototypes.data()}, layout, letterbox, config);
  }
  std::vector<Detection> decode() const {
    return decode(fit_letterbox(kSide, kSide, kSide, kSide));
  }

  float& prototype(int k, int x, int y) {
    return prototypes[static_cast<std::size_t>((k * kMask + y) * kMask + x)];
  }
};

std::vector<float> channels_of(const Proposal& proposal, YoloFormat format) {
  std::vector<float> channels(proposal.box.begin(), proposal.box.end());
  if (format == YoloFormat::kV5) channels.push_back(proposal.objectness);
  channels.insert(channels.end(), proposal.classes.begin(), proposal.classes.end());
  channels.insert(channels.end(), proposal.coefficients.begin(), proposal.coefficients.end());
  return channels;
}

/// In the layout of the formats, without YoloLayout::index.
Outputs outputs_of(const std::vector<Proposal>& proposals, YoloFormat format = YoloFormat::kV8) {
  const int count = static_cast<int>(proposals.size());
  const std::size_t channels = channels_of({}, format).size();
  const int values = static_cast<int>(channels);
  const bool rows = format == YoloFormat::kV5;
  Outputs outputs;
  outputs.layout = find_layout(
      {rows ? Shape{1, count, values} : Shape{1, values, count}, {1, 2, kMask, kMask}}, 2, "test");
  for (std::size_t i = 0; i < channels * proposals.size(); ++i) {
    const std::size_t object = rows ? i / channels : i % proposals.size();
    const std::size_t channel = rows ? i % channels : i / proposals.size();
    outputs.predictions.push_back(channels_of(proposals[object], format)[channel]);
  }
  return outputs;
}

int area(const Detection& detection) {
  int sum = 0;
  for (const std::uint8_t pixel : detection.mask.pixels()) sum += pixel;
  return sum;
}

/// Expects a mask that is a full rectangle.
void expect_rectangle(const Detection& found, int x, int y, int width, int height) {
  EXPECT_EQ(found.x, x);
  EXPECT_EQ(found.y, y);
  EXPECT_EQ(found.mask.width(), width);
  EXPECT_EQ(found.mask.height(), height);
  EXPECT_EQ(area(found), width * height);
}

TEST(YoloDecoder, BothFormatsGiveSameObjects) {
  const std::vector<Proposal> proposals = {
      {.box = {20, 20, 8, 8}, .classes = {0.1F, 0.5F}},
      {.box = {40, 30, 16, 12}, .classes = {0.75F, 0.2F}},
      {.box = {10, 50, 8, 8}, .classes = {0.1F, 0.2F}},
  };
  for (const auto format : {YoloFormat::kV5, YoloFormat::kV8}) {
    const std::vector<Detection> found = outputs_of(proposals, format).decode();
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].category, 0);
    EXPECT_FLOAT_EQ(found[0].score, 0.75F);
    expect_rectangle(found[0], 32, 24, 16, 12);
    EXPECT_EQ(found[1].category, 1);
    EXPECT_FLOAT_EQ(found[1].score, 0.5F);
    expect_rectangle(found[1], 16, 16, 8, 8);
  }
}

TEST(YoloDecoder, MultipliesObjectnessInYolo5) {
  const std::vector<Proposal> proposals = {{.classes = {0.8F, 0.5F}, .objectness = 0.5F},
                                           {.classes = {0.8F, 0.5F}, .objectness = 0.3F}};
  const std::vector<Detection> found = outputs_of(proposals, YoloFormat::kV5).decode();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_FLOAT_EQ(found[0].score, 0.4F);
}

TEST(YoloDecoder, MaskIsSumOfPrototypes) {
  Outputs outputs = outputs_of({{.box = {32, 32, 64, 64}, .coefficients = {2.0F, -1.0F}}});
  for (int y = 0; y < kMask; ++y) {
    for (int x = 0; x < kMask; ++x) {
      const bool inside = x >= 4 && x < 9 && y >= 6 && y < 8;
      outputs.prototype(0, x, y) = inside ? 20.0F : 10.0F;
      outputs.prototype(1, x, y) = 30.0F;  // 2 * 20 - 30 is above 0, 2 * 10 - 30 as much below
    }
  }
  const std::vector<Detection> found = outputs.decode();
  ASSERT_EQ(found.size(), 1U);
  const Detection& object = found[0];  // from (16, 24) to (36, 32)
  EXPECT_EQ(object.x, 16);
  EXPECT_EQ(object.y, 24);
  EXPECT_EQ(object.mask.width(), 20);
  EXPECT_EQ(object.mask.height(), 8);
  EXPECT_EQ(area(object), 20 * 8 - 4);  // bilinear: a corner pixel has 5/8 of 5/8
  EXPECT_EQ(object.mask(0, 0) + object.mask(19, 0) + object.mask(0, 7) + object.mask(19, 7), 0);
}

TEST(YoloDecoder, InterpolatesProbabilitiesBilinearly) {
  Outputs outputs = outputs_of({{.box = {32, 32, 64, 64}}});
  for (int y = 0; y < kMask; ++y) {
    for (int x = 0; x < kMask; ++x) {
      outputs.prototype(0, x, y) = x < 4 ? -std::log(3.0F) : kCertain;  // 1/4 and 1
    }
  }
  const std::vector<Detection> found = outputs.decode();
  ASSERT_EQ(found.size(), 1U);
  // 1/2 is at a third of the distance from the center of prototype 3, 14, to that of 4, 18 [px].
  expect_rectangle(found[0], 15, 0, kSide - 15, kSide);
}

TEST(YoloDecoder, CropsMaskToBox) {
  const Outputs outputs = outputs_of({{.box = {15.5F, 30.0F, 10.2F, 21.0F}}});
  const std::vector<Detection> found = outputs.decode();
  ASSERT_EQ(found.size(), 1U);
  // 10.4 to 20.6, and 19.5 to 40.5: the pixels with their centers inside.
  expect_rectangle(found[0], 10, 19, 11, 21);
}

TEST(YoloDecoder, ClipsBoxesToImage) {
  const Outputs outputs = outputs_of({{.box = {0.0F, 60.0F, 20.0F, 20.0F}}});
  const std::vector<Detection> found = outputs.decode();
  ASSERT_EQ(found.size(), 1U);
  expect_rectangle(found[0], 0, 50, 10, 14);
}

TEST(YoloDecoder, MapsBackThroughLetterbox) {
  const Outputs outputs = outputs_of({{.box = {24, 32, 16, 16}}});
  const std::vector<Detection> wide = outputs.decode(fit_letterbox(128, 64, kSide, kSide));
  ASSERT_EQ(wide.size(), 1U);  // 16 px of padding above, then twice the size
  expect_rectangle(wide[0], 32, 16, 32, 32);
  const std::vector<Detection> tall = outputs.decode(fit_letterbox(16, 32, kSide, kSide));
  ASSERT_EQ(tall.size(), 1U);  // 16 px of padding left, then half the size
  expect_rectangle(tall[0], 0, 12, 8, 8);
}

TEST(YoloDecoder, UnevenLetterboxCoversImage) {
  const Outputs outputs = outputs_of({{.box = {32, 32, 64, 64}}});
  const std::vector<Detection> found = outputs.decode(fit_letterbox(100, 33, kSide, kSide));
  ASSERT_EQ(found.size(), 1U);
  expect_rectangle(found[0], 0, 0, 100, 33);
}

TEST(YoloDecoder, IgnoresObjectsInPadding) {
  const Outputs outputs = outputs_of({{.box = {32, 8, 16, 15}}, {.box = {32, 56, 16, 15}}});
  EXPECT_TRUE(outputs.decode(fit_letterbox(128, 64, kSide, kSide)).empty());
}

TEST(YoloDecoder, NmsSuppressesWithinClass) {
  const std::vector<Proposal> proposals = {
      {.box = {30, 32, 16, 16}, .classes = {0.5F, 0.0F}},   // over the best
      {.box = {32, 32, 16, 16}, .classes = {0.9F, 0.0F}},   // the best
      {.box = {31, 32, 16, 16}, .classes = {0.0F, 0.6F}},   // over the best, of another class
      {.box = {48, 32, 16, 16}, .classes = {0.7F, 0.0F}},   // beside the best
      {.box = {32, 31, 16, 16}, .classes = {0.0F, 0.55F}},  // over the other class's
  };
  const std::vector<Detection> found = outputs_of(proposals).decode();
  ASSERT_EQ(found.size(), 3U);
  EXPECT_FLOAT_EQ(found[0].score, 0.9F);
  EXPECT_FLOAT_EQ(found[1].score, 0.7F);
  EXPECT_FLOAT_EQ(found[2].score, 0.6F);
  EXPECT_EQ(found[2].category, 1);
}

TEST(YoloDecoder, LimitsOverlapAndNumber) {
  const std::vector<Proposal> proposals = {{.box = {20, 20, 16, 16}, .classes = {0.9F, 0.0F}},
                                           {.box = {20, 24, 16, 8}, .classes = {0.8F, 0.0F}},
                                           {.box = {50, 50, 8, 8}, .classes = {0.7F, 0.0F}}};
  const Letterbox letterbox = fit_letterbox(kSide, kSide, kSide, kSide);
  const Outputs outputs = outputs_of(proposals);  // the second is half of the first
  EXPECT_EQ(outputs.decode(letterbox, {.overlap = 0.5}).size(), 3U);
  EXPECT_EQ(outputs.decode(letterbox, {.overlap = 0.49}).size(), 2U);
  EXPECT_EQ(outputs.decode(letterbox, {.overlap = 1.0, .instances = 2}).size(), 2U);
  EXPECT_EQ(outputs.decode(letterbox, {.score = 0.75, .overlap = 1.0}).size(), 2U);
}

TEST(YoloDecoder, KeepsScoresAboveThreshold) {
  const std::vector<Proposal> proposals = {{.classes = {0.25F, 0.0F}}, {.classes = {0.0F, 0.26F}}};
  const std::vector<Detection> found = outputs_of(proposals).decode();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].category, 1);
}

TEST(YoloDecoder, IgnoresInvalidScoresAndBoxes) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInf = std::numeric_limits<float>::infinity();
  constexpr float kMost = std::numeric_limits<float>::max();
  const std::vector<Proposal> proposals = {
      {.box = {kNan, 32, 16, 16}}, {.box = {32, 32, kInf, 16}},  {.box = {32, -kInf, 16, 16}},
      {.box = {32, 32, 0, 16}},    {.box = {32, 32, 16, -16}},   {.box = {-90, 32, 16, 16}},
      {.box = {32, 900, 16, 16}},  {.classes = {kNan, kNan}},    {.coefficients = {kNan, 1}},
      {.classes = {-1, -kInf}},    {.box = {kMost, 32, 16, 16}}, {.objectness = kNan},
  };
  Outputs outputs = outputs_of(proposals);
  const std::vector<Detection> found =
      outputs.decode(fit_letterbox(kSide, kSide, kSide, kSide), {.overlap = 1.0});
  ASSERT_EQ(found.size(), 1U);  // objectness is YOLOv5's
  EXPECT_EQ(outputs_of(proposals, YoloFormat::kV5).decode().size(), 0U);
  const std::vector<Detection> huge =
      outputs_of({{.box = {32, 32, 1e30F, 1e30F}, .classes = {kInf, 0}}}).decode();
  ASSERT_EQ(huge.size(), 1U);
  EXPECT_EQ(huge[0].score, 1.0F);
  expect_rectangle(huge[0], 0, 0, kSide, kSide);
}

/// The mask's definition, pixel by pixel, in double.
bool set_by_definition(const Outputs& outputs, const Proposal& p, const Letterbox& l, int x,
                       int y) {
  const auto position = [](const LetterboxAxis& axis, int pixel) {
    return (pixel + 0.5) * axis.scaled / axis.image + axis.offset;
  };
  const double u = position(l.x, x);
  const double v = position(l.y, y);
  if (std::abs(u - p.box[0]) > p.box[2] / 2 || std::abs(v - p.box[1]) > p.box[3] / 2) return false;
  const double s = std::clamp(u * kMask / l.x.input - 0.5, 0.0, kMask - 1.0);
  const double t = std::clamp(v * kMask / l.y.input - 0.5, 0.0, kMask - 1.0);
  double sum = 0.0;
  for (int row = 0; row < kMask; ++row) {
    for (int column = 0; column < kMask; ++column) {
      const double weight =
          std::max(0.0, 1.0 - std::abs(s - column)) * std::max(0.0, 1.0 - std::abs(t - row));
      const auto at = static_cast<std::size_t>(row * kMask + column);
      const double logit = p.coefficients[0] * outputs.prototypes[at] +
                           p.coefficients[1] * outputs.prototypes[kMask * kMask + at];
      sum += weight / (1.0 + std::exp(-logit));
    }
  }
  return sum > 0.5;
}

TEST(YoloDecoder, EqualsDefinition) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> number(-1.0F, 1.0F);
  for (const auto& [width, height] : {std::pair(97, 41), {30, 77}, {64, 64}, {13, 200}}) {
    const Proposal proposal{.box = {32 + 9 * number(random), 32 + 9 * number(random), 33.3F, 27.7F},
                            .coefficients = {3 * number(random), 3 * number(random)}};
    Outputs outputs = outputs_of({proposal});
    for (float& value : outputs.prototypes) value = 3 * number(random);
    const Letterbox letterbox = fit_letterbox(width, height, kSide, kSide);
    const std::vector<Detection> found = outputs.decode(letterbox);
    ASSERT_EQ(found.size(), 1U);
    const Detection& object = found[0];
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const bool set = object.mask.contains(x - object.x, y - object.y) &&
                         object.mask(x - object.x, y - object.y) != 0;
        EXPECT_EQ(set, set_by_definition(outputs, proposal, letterbox, x, y)) << x << " " << y;
      }
    }
  }
}

TEST(Letterbox, KeepsAspectAndCenters) {
  const auto expect_axis = [](const LetterboxAxis& axis, int scaled, int offset) {
    EXPECT_EQ(axis.scaled, scaled);
    EXPECT_EQ(axis.offset, offset);
  };
  const Letterbox kinect = fit_letterbox(640, 480, 640, 640);
  expect_axis(kinect.x, 640, 0);
  expect_axis(kinect.y, 480, 80);
  const Letterbox full_hd = fit_letterbox(1920, 1080, 640, 384);
  expect_axis(full_hd.x, 640, 0);
  expect_axis(full_hd.y, 360, 12);
  const Letterbox odd = fit_letterbox(33, 100, 64, 64);  // 33 * 0.64 is 21.12
  expect_axis(odd.x, 21, 21);
  expect_axis(odd.y, 64, 0);
  const Letterbox line = fit_letterbox(10000, 1, 64, 64);
  expect_axis(line.x, 64, 0);
  expect_axis(line.y, 1, 31);
}

TEST(Letterbox, RoundTrips) {
  const Letterbox letterbox = fit_letterbox(1280, 720, 640, 640);
  EXPECT_FLOAT_EQ(letterbox.y.to_input(0.0F), 140.0F);
  EXPECT_FLOAT_EQ(letterbox.y.to_input(720.0F), 500.0F);
  EXPECT_FLOAT_EQ(letterbox.x.to_image(320.0F), 640.0F);
  EXPECT_FLOAT_EQ(letterbox.y.to_image(letterbox.y.to_input(123.5F)), 123.5F);
}

}  // namespace
}  // namespace mms::onnx
