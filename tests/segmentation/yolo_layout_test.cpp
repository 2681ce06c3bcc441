#include "mms/segmentation/onnx/yolo_layout.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms::onnx {
namespace {

using testing::expect_in;
using testing::message_of;

TEST(YoloLayout, RecognizesShapesOfCocoModels) {
  const YoloLayout v8 = find_layout({{1, 116, 8400}, {1, 32, 160, 160}}, 80, "net");
  EXPECT_EQ(v8.format, YoloFormat::kV8);
  EXPECT_EQ(v8.predictions, 0U);
  EXPECT_EQ(v8.prototypes, 1U);
  EXPECT_EQ(v8.objects, 8400);
  EXPECT_EQ(v8.coefficients, 32);
  EXPECT_EQ(v8.first_class(), 4);
  EXPECT_EQ(v8.first_coefficient(), 84);
  EXPECT_EQ(v8.channels(), 116);
  EXPECT_EQ(v8.index(7, 3), 3U * 8400 + 7);

  const YoloLayout v5 = find_layout({{1, 32, 96, 160}, {1, 15120, 117}}, 80, "net");
  EXPECT_EQ(v5.format, YoloFormat::kV5);
  EXPECT_EQ(v5.predictions, 1U);
  EXPECT_EQ(v5.prototypes, 0U);
  EXPECT_EQ(v5.objects, 15120);
  EXPECT_EQ(v5.mask_width, 160);
  EXPECT_EQ(v5.mask_height, 96);
  EXPECT_EQ(v5.first_class(), 5);
  EXPECT_EQ(v5.channels(), 117);
  EXPECT_EQ(v5.index(7, 3), 7U * 117 + 3);
}

TEST(YoloLayout, RefusesModelsThatSuppressDuplicates) {
  expect_in("export it again with end2end=False", message_of<DataError>([] {
              find_layout({{1, 300, 38}, {1, 32, 160, 160}}, 1, "net.onnx");
            }));
  EXPECT_EQ(find_layout({{1, 25200, 38}, {1, 32, 160, 160}}, 1, "net.onnx").format,
            YoloFormat::kV5);
}

TEST(YoloLayout, ErrorsNameFoundAndSupportedShapes) {
  const auto error = [](const std::vector<Shape>& outputs, int classes) {
    return message_of<DataError>([&] { find_layout(outputs, classes, "net.onnx"); });
  };
  EXPECT_EQ(error({{1, 116, 8400}, {1, 32, 160, 160}}, 2),
            "net.onnx: gives (1, 116, 8400) and (1, 32, 160, 160), supported for 2 classes: "
            "(1, 4 + 2 + M, N) of YOLOv8-seg and YOLO11-seg and (1, N, 5 + 2 + M) of YOLOv5-seg, "
            "each with (1, M, H, W) (use a model for segmentation, exported without NMS, and give "
            "its class names in order)");
  expect_in("gives (1, 84, 8400), supported", error({{1, 84, 8400}}, 80));
  expect_in("gives nothing, supported", error({}, 80));
  expect_in("gives (2, 116, 8400) and (1, 32, 160, 160)",
            error({{2, 116, 8400}, {1, 32, 160, 160}}, 80));
  expect_in("gives (1, 116, 0) and", error({{1, 116, 0}, {1, 32, 160, 160}}, 80));
  expect_in("gives (1, 300, 38): objects after", error({{1, 300, 38}, {1, 32, 160, 160}}, 80));
  expect_in("gives (1, 116, 8400) and (1, 116, 8400)", error({{1, 116, 8400}, {1, 116, 8400}}, 80));
  expect_in("gives (1, 32, 4, 4) and () and ()", error({{1, 32, 4, 4}, {}, {}}, 80));
  expect_in("gives (1, 32, 4, 4) and (1, 32, 4, 4)", error({{1, 32, 4, 4}, {1, 32, 4, 4}}, 80));
}

}  // namespace
}  // namespace mms::onnx
