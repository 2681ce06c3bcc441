#include "mms/segmentation/onnx/onnx_detector.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/segmentation/detection/coco_classes.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/segmentation/tiny_onnx.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests
using onnx::YoloFormat;
using Names = std::vector<std::string>;

constexpr Rgb kRed{255, 0, 0};
constexpr Rgb kBlue{0, 0, 255};

void draw(Image<Rgb>& image, int left, int top, int width, int height, Rgb color) {
  for (int y = top; y < top + height; ++y) {
    for (int x = left; x < left + width; ++x) image(x, y) = color;
  }
}

OnnxDetector detector_of(const TempFolder& folder, const TinyOnnx& model,
                         const OnnxConfig& config = {}) {
  return {folder.write("net.onnx", tiny_onnx(model)), config, 1};
}

/// The mask of a square of prototypes with `stride` px each; bilinear interpolation rounds the
/// corners.
std::vector<std::uint8_t> square(int side, int stride) {
  const auto share = [&](int i) {
    const int inside = std::min(i, side - 1 - i);
    return std::min(1.0, 0.5 + (inside + 0.5) / stride);
  };
  std::vector<std::uint8_t> pixels;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) pixels.push_back(share(x) * share(y) > 0.5 ? 1 : 0);
  }
  return pixels;
}

/// Expects a square of two prototypes per side.
void expect_object(const Detection& found, int category, float score, int x, int y, int side) {
  EXPECT_EQ(found.category, category);
  EXPECT_NEAR(found.score, score, 1e-5);
  EXPECT_EQ(found.x, x);
  EXPECT_EQ(found.y, y);
  EXPECT_EQ(found.mask.width(), side);
  EXPECT_EQ(found.mask.pixels(), square(side, side / 2));
}

TEST(OnnxDetector, DetectsObjects) {
  const TempFolder folder;
  Image<Rgb> image(64, 64);
  draw(image, 16, 8, 8, 8, kRed);
  draw(image, 48, 40, 8, 8, {0, 0, 200});
  for (const auto& [format, objectness] :
       {std::pair(YoloFormat::kV8, 1.0F), {YoloFormat::kV5, 0.5F}}) {
    OnnxDetector detector = detector_of(folder, {.format = format});
    EXPECT_EQ(detector.classes(), (Names{"r", "b"}));
    const std::vector<Detection> found = detector.detect(image);
    ASSERT_EQ(found.size(), 2U);
    expect_object(found[0], 0, 0.9F * objectness, 16, 8, 8);
    expect_object(found[1], 1, 0.9F * objectness * 200 / 255, 48, 40, 8);
  }
}

TEST(OnnxDetector, AcceptsImagesOfAnyShape) {
  const TempFolder folder;
  OnnxDetector detector = detector_of(folder, {});
  Image<Rgb> wide(128, 64);
  draw(wide, 32, 16, 16, 16, kBlue);
  std::vector<Detection> found = detector.detect(wide);
  ASSERT_EQ(found.size(), 1U);
  expect_object(found[0], 1, 0.9F, 32, 16, 16);
  Image<Rgb> tall(8, 32);
  draw(tall, 0, 8, 8, 8, kRed);  // 16 px in the input, from (24, 16) on
  found = detector.detect(tall);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].category, 0);
  EXPECT_EQ(found[0].x, 0);
  EXPECT_NEAR(found[0].y, 8, 1);
  EXPECT_TRUE(detector.detect(Image<Rgb>(1, 4000)).empty());
  EXPECT_TRUE(detector.detect(Image<Rgb>(0, 0)).empty());
}

TEST(OnnxDetector, SameResultForAnyThreadCount) {
  const TempFolder folder;
  const auto model = folder.write("net.onnx", tiny_onnx({}));
  Image<Rgb> image(97, 131);
  for (std::size_t i = 0; i < image.size(); ++i) {
    image[i] = {static_cast<std::uint8_t>(i * i % 251), 0, static_cast<std::uint8_t>(i % 239)};
  }
  const std::vector<Detection> one = OnnxDetector(model, {}, 1).detect(image);
  const std::vector<Detection> many = OnnxDetector(model, {}, 0).detect(image);
  ASSERT_FALSE(one.empty());
  ASSERT_EQ(one.size(), many.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].score, many[i].score);
    EXPECT_EQ(one[i].mask.pixels(), many[i].mask.pixels());
  }
}

TEST(OnnxDetector, ConfiguredClassesOverrideFile) {
  const TempFolder folder;
  EXPECT_EQ(detector_of(folder, {}, {.classes = "person, agv"}).classes(),
            (Names{"person", "agv"}));
  expect_in("supported for 3 classes: (1, 4 + 3 + M, N)",
            message_of<DataError>([&] { detector_of(folder, {}, {.classes = "person,agv,dog"}); }));
  expect_in("supported for 80 classes:",
            message_of<DataError>([&] { detector_of(folder, {.names = "unreadable"}); }));
  expect_in("classes: class 2 of 'person,' is empty",
            message_of<DataError>([&] { detector_of(folder, {}, {.classes = "person,"}); }));
}

TEST(OnnxDetector, RejectsNamesThatJsonCannotHold) {
  const TempFolder folder;
  const TinyOnnx model{.names = "{0: 'r', 1: 'b\xff'}"};
  expect_in("the name of class 1 is not UTF-8 (name the classes by the setting",
            message_of<DataError>([&] { detector_of(folder, model); }));
  EXPECT_EQ(detector_of(folder, model, {.classes = "person, agv"}).classes(),
            (Names{"person", "agv"}));
  expect_in("classes: the name of class 0 is not UTF-8", message_of<DataError>([&] {
              detector_of(folder, {}, {.classes = "\xed\xa0\x80, agv"});
            }));
}

TEST(OnnxDetector, UsesConfiguredSideForOpenInput) {
  const TempFolder folder;
  Image<Rgb> image(64, 64);
  draw(image, 16, 8, 8, 8, kRed);
  OnnxDetector detector = detector_of(folder, {.side = 0}, {.input_side = 64});
  EXPECT_EQ(detector.detect(image).size(), 1U);
  const std::string error = message_of<DataError>([&] { detector_of(folder, {.side = 0}); });
  expect_in("cannot run it on 640x640 px: ", error);
}

TEST(OnnxDetector, ErrorsNameInvalidModel) {
  const TempFolder folder;
  const auto error = [&](const std::string& bytes) {
    const auto path = folder.write("net.onnx", bytes);
    const std::string message = message_of<DataError>([&] { OnnxDetector(path, {}, 1); });
    EXPECT_TRUE(message.starts_with(path.string() + ": ")) << message;
    return message;
  };
  expect_in("has no graph", error(""));
  expect_in("is not a complete ONNX model", error("not a model at all"));
  const std::string whole = tiny_onnx({});
  expect_in("is not a complete ONNX model: it has a field of", error(whole.substr(0, 5000)));
  expect_in("gives (1, 8, 64), supported for 2 classes", error(tiny_onnx({.prototypes = false})));
  expect_in("has an input of shape (1, 1, 64, 64)", error(tiny_onnx({.channels = 1})));
  const std::string unknown = error(tiny_onnx({.last = "Frobnicate"}));
  expect_in("OpenCV ", unknown);
  expect_in("Frobnicate", unknown);
  expect_in("(export it with opset=12 simplify=True, YOLO26 also with end2end=False)", unknown);
}

TEST(OnnxDetector, ErrorsNameUnreadableFile) {
  const TempFolder folder;
  const auto error = [](const std::filesystem::path& path) {
    return message_of<FileError>([&] { OnnxDetector(path, {}, 1); });
  };
  expect_in("nowhere.onnx: no such file", error(folder.path() / "nowhere.onnx"));
  expect_in(": is not a regular file", error(folder.path()));
}

TEST(OnnxDetector, TruncationCausesDataError) {
  const TempFolder folder;
  const std::string whole = tiny_onnx({});
  for (std::size_t size = 0; size + 40 < whole.size(); size += 149) {
    const auto path = folder.write("net.onnx", whole.substr(0, size));
    EXPECT_THROW(OnnxDetector(path, {}, 1), DataError) << size;
  }
}

}  // namespace
}  // namespace mms
