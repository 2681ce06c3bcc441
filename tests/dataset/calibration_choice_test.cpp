#include "mms/dataset/source/calibration_choice.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "tests/dataset/recording.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

Frame first_frame(const TempFolder& folder, const CameraOptions& camera) {
  return Playback(open_dataset(folder.path(), {.camera = camera})).frames.at(0);
}

TEST(CalibrationChoice, FileReplacesThatOfTheFolder) {
  const TempFolder folder;
  write_tum(folder, 1);
  const auto file =
      folder.write("elsewhere/mine.yaml",
                   "fx: 20\nfy: 21\ncx: 4\ncy: 3\nwidth: 8\nheight: 6\ndepth_scale: 500\n");
  const Frame frame = first_frame(folder, {.file = file});
  EXPECT_EQ(frame.calibration->camera->fy, 21.0);
  EXPECT_EQ(frame.depth(0, 0), 3.0F);
  EXPECT_TRUE(any_has(open_dataset(folder.path(), {.camera = {.file = file}})->describe(),
                      "calibration: " + file.string()));
}

TEST(CalibrationChoice, IntrinsicsAndDepthScaleReplaceThoseOfTheFile) {
  const TempFolder folder;
  write_tum(folder, 1);
  const Frame frame =
      first_frame(folder, {.intrinsics = {{30, 31, 3.5, 2.5}}, .depth_scale = 750.0});
  EXPECT_EQ(frame.calibration->camera->fx, 30.0);
  EXPECT_EQ(frame.calibration->camera->cy, 2.5);
  EXPECT_EQ(frame.calibration->camera->width, kWidth);
  EXPECT_EQ(frame.depth(0, 0), 2.0F);
}

TEST(CalibrationChoice, IntrinsicsServeWhereThereIsNoFile) {
  const TempFolder folder;
  write_tum(folder, 1);
  std::filesystem::remove(folder.path() / "calibration.yaml");
  expect_in("give --calibration, or --intrinsics",
            message_of<DataError>([&] { open_dataset(folder.path()); }));
  const Frame frame = first_frame(folder, {.intrinsics = {{30, 31, 3.5, 2.5}}});
  EXPECT_EQ(frame.calibration->camera->fy, 31.0);
  EXPECT_EQ(frame.depth(0, 0), 1.5F) << "1000 units per meter";
}

TEST(CalibrationChoice, OptionsOfImagesAreRejectedElsewhere) {
  const TempFolder folder;
  folder.write("000000.bin", std::string(16, '\0'));
  const auto error = [](const std::filesystem::path& data, const CameraOptions& camera) {
    return message_of<DataError>([&] { open_dataset(data, {.camera = camera}); });
  };
  expect_in("is no folder of color and depth images", error(folder.path(), {.depth_scale = 1.0}));
  expect_in("is a simulation and has its own camera", error("sim:static", {.depth_scale = 1.0}));
}

}  // namespace
}  // namespace mms
