#include "mms/dataset/tum/tum_rgbd.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "mms/dataset/tum/tum_calibration.hpp"
#include "tests/dataset/recording.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

std::string error_of(const TempFolder& folder, const SourceOptions& options = {}) {
  return message_of<DataError>([&] { open_dataset(folder.path(), options); });
}

TEST(TumRgbd, ReadsFrames) {
  const TempFolder folder;
  write_tum(folder, 3);
  folder.write("groundtruth.txt", "5.0 1 2 3 0 0 0 1\n");
  const Playback played(open_dataset(folder.path()));
  EXPECT_EQ(played.names(), "f0 f1 f2");
  EXPECT_EQ(played.source->size(), 3U);
  EXPECT_EQ(played.source->skipped(), 0U);
  EXPECT_TRUE(played.warnings.empty());
  EXPECT_EQ(played.source->ground_truth().size(), 1U);
  const Frame& frame = played.frames[2];
  EXPECT_EQ(frame.index, 2);
  EXPECT_EQ(frame.stamp, Timestamp(5'200'000'000));
  EXPECT_EQ(frame.color(7, 5), (Rgb{2, 0, 0}));
  EXPECT_EQ(frame.depth(7, 5), 1.5F);
  EXPECT_TRUE(frame.mask.empty());
  EXPECT_EQ(frame.calibration->camera->fx, 10.0);
}

TEST(TumRgbd, DescribesItself) {
  const TempFolder folder;
  write_tum(folder, 3);
  const auto lines = open_dataset(folder.path())->describe();
  for (const char* fact :
       {"layout: TUM RGB-D", "3 color and 3 depth images, 3 matched", "calibration.yaml",
        "masks: none", "sensor: depth camera, 8x6 pixels", "depth scale: 1000 units", "frames: 3",
        "0.200 s", "rate: 10.00 Hz", "ground truth: none"}) {
    EXPECT_TRUE(any_has(lines, fact)) << fact;
  }
}

TEST(TumRgbd, SkipsFrames) {
  const TempFolder folder;
  write_tum(folder, 4);
  const auto source = open_dataset(folder.path());
  source->skip(2);
  EXPECT_EQ(source->next()->name, "f2");
  source->skip(100);
  EXPECT_FALSE(source->next());
  EXPECT_EQ(source->skipped(), 0U);
}

TEST(TumRgbd, ReadsAssociationsInEitherOrder) {
  const TempFolder folder;
  write_tum(folder, 2);
  std::filesystem::remove(folder.path() / "depth.txt");
  folder.write("associations.txt", "5.0 rgb/f0.png 5.01 depth/f0.png\n");
  EXPECT_EQ(Playback(open_dataset(folder.path())).names(), "f0");
  folder.write("associations.txt", "5.01 depth/f1.png 5.0 rgb/f1.png\n");
  const Playback played(open_dataset(folder.path()));
  EXPECT_EQ(played.names(), "f1");
  EXPECT_EQ(played.frames[0].stamp, Timestamp(5'000'000'000));
}

TEST(TumRgbd, SkipsAndReportsDamagedFrames) {
  const TempFolder folder;
  write_tum(folder, 7);
  const auto color = [&](int i) { return folder.path() / "rgb" / file_of(i); };
  std::filesystem::remove(color(0));
  folder.write("rgb/f1.png", std::string("\x89PNG\r\n\x1a\nhalf", 12));
  folder.write("rgb/f2.png", "");
  write_png(color(3), Image<Rgb>(4, 3));
  write_png(folder.path() / "depth/f4.png", Image<std::uint16_t>(4, 3));
  write_png(folder.path() / "depth/f5.png", Image<std::uint8_t>(kWidth, kHeight));
  const Playback played(open_dataset(folder.path()));
  EXPECT_EQ(played.names(), "f6");
  EXPECT_EQ(played.frames[0].index, 6);
  EXPECT_EQ(played.source->skipped(), 6U);
  ASSERT_EQ(played.warnings.size(), 6U);
  const char* errors[] = {"no such file",
                          "truncated PNG",
                          "is empty",
                          "is 4x3 pixels, the calib",
                          "is 4x3 pixels, the calib",
                          "16-bit depth image"};
  for (std::size_t i = 0; i < 6; ++i) {
    expect_in(std::string("frame f").append(std::to_string(i)) + " skipped: ", played.warnings[i]);
    expect_in(errors[i], played.warnings[i]);
  }
}

TEST(TumRgbd, ReturnsNoFramesWhenAllAreDamaged) {
  const TempFolder folder;
  write_tum(folder, 3);
  std::filesystem::remove_all(folder.path() / "depth");
  const Playback played(open_dataset(folder.path()));
  EXPECT_TRUE(played.frames.empty());
  EXPECT_EQ(played.source->skipped(), played.source->size());
}

TEST(TumRgbd, AcceptsDepthWithoutReturns) {
  const TempFolder folder;
  write_tum(folder, 1);
  write_depth(folder.path() / "depth/f0.png", 0);
  const Playback played(open_dataset(folder.path()));
  ASSERT_EQ(played.frames.size(), 1U);
  EXPECT_EQ(played.frames[0].depth(0, 0), 0.0F);
}

TEST(TumRgbd, KeepsFirstOfDuplicateStamps) {
  const TempFolder folder;
  write_tum(folder, 3);
  folder.write("rgb.txt", "5.0 rgb/f0.png\n5.0 rgb/f1.png\n5.2 rgb/f2.png\n");
  const Playback played(open_dataset(folder.path()));
  EXPECT_EQ(played.names(), "f0 f2");
  EXPECT_TRUE(any_has(played.warnings, "rgb.txt:2: line skipped, duplicate stamp"));
}

TEST(TumRgbd, SortsUnsortedLists) {
  const TempFolder folder;
  write_tum(folder, 3);
  folder.write("rgb.txt", "5.1 rgb/f1.png\n5.0 rgb/f0.png\n5.2 rgb/f2.png\n");
  const Playback played(open_dataset(folder.path()));
  EXPECT_EQ(played.names(), "f0 f1 f2");
  EXPECT_EQ(played.source->skipped(), 0U);
  EXPECT_TRUE(any_has(played.source->describe(), "stamps: not in order in the list, sorted"));
}

TEST(TumRgbd, KeepsOrderWhereStampsAreNoTimes) {
  const TempFolder folder;
  write_tum(folder, 5);
  std::string color;
  std::string depth;
  const char* intervals[] = {"0.0021", "0.0019", "0.0030", "0.0018", "0.0020"};
  for (int i = 0; i < 5; ++i) {
    color += std::string(intervals[i]) + " rgb/" + file_of(i) + "\n";
    depth += std::string(intervals[i]) + " depth/" + file_of(i) + "\n";
  }
  folder.write("rgb.txt", color);
  folder.write("depth.txt", depth);
  const Playback played(open_dataset(folder.path()));
  EXPECT_EQ(played.names(), "f0 f1 f2 f3 f4");
  EXPECT_EQ(played.frames[3].stamp, Timestamp(200'000'000));
  EXPECT_TRUE(any_has(played.warnings, "5 images within 0.0012 s; they are no times"));
}

/// Taken as seconds they would be frames at 1 Hz.
TEST(TumRgbd, TakesWholeNumbersForImagesWithoutStamps) {
  const TempFolder folder;
  write_tum(folder, 5);
  std::string pairs;
  for (int i = 0; i < 5; ++i) {
    const std::string number = std::to_string(i + 100);
    pairs += number + " rgb/" + file_of(i) + " " + number + " depth/" + file_of(i) + "\n";
  }
  std::filesystem::remove(folder.path() / "rgb.txt");
  std::filesystem::remove(folder.path() / "depth.txt");
  folder.write("associations.txt", pairs);
  folder.write("groundtruth.txt", "100 0 0 0 0 0 0 1\n104 1 0 0 0 0 0 1\n");
  const Playback played(open_dataset(folder.path()));
  ASSERT_EQ(played.names(), "f0 f1 f2 f3 f4");
  EXPECT_EQ(played.frames[4].stamp, Timestamp(6'933'333'333));
  EXPECT_EQ(played.source->ground_truth()[1].stamp, played.frames[4].stamp);
  EXPECT_TRUE(any_has(played.warnings, "no time stamps: 15 Hz is assumed"));
  SourceOptions options;
  options.rate = 20.0;
  EXPECT_EQ(Playback(open_dataset(folder.path(), options)).frames[4].stamp,
            Timestamp(5'200'000'000));
  // Decimals are stamps, of 1 Hz here.
  folder.write("associations.txt",
               "100.0 rgb/f0.png 100.0 depth/f0.png\n101.0 rgb/f1.png 101.0 depth/f1.png\n"
               "102.0 rgb/f2.png 102.0 depth/f2.png\n103.0 rgb/f3.png 103.0 depth/f3.png\n"
               "104.0 rgb/f4.png 104.0 depth/f4.png\n");
  EXPECT_EQ(Playback(open_dataset(folder.path())).frames[4].stamp, Timestamp(104'000'000'000));
}

TEST(TumRgbd, ReadsPairsOfImages) {
  for (const char* name : {"associations.txt", "association.txt", "associate.txt"}) {
    const TempFolder folder;
    write_tum(folder, 2);
    std::filesystem::remove(folder.path() / "rgb.txt");
    std::filesystem::remove(folder.path() / "depth.txt");
    folder.write(name, "5.0 depth/f0.png 5.0 rgb/f0.png\n5.1 depth/f1.png 5.1 rgb/f1.png\n");
    const Playback played(open_dataset(folder.path()));
    EXPECT_EQ(played.names(), "f0 f1") << name;
  }
}

TEST(TumRgbd, OpensNumberedImagesWithoutLists) {
  const TempFolder folder;
  for (const int i : {9, 10, 11}) {
    write_color(folder.path() / "rgb" / ("color_" + std::to_string(i) + ".png"));
    write_depth(folder.path() / "depth" / (std::to_string(i) + "-depth.png"));
  }
  write_depth(folder.path() / "depth" / "12-depth.png");
  expect_in("has no camera calibration", error_of(folder));
  const SourceOptions options{.camera = {.intrinsics = {{10, 10, 4, 3}}, .depth_scale = 1000.0}};
  const Playback played(open_dataset(folder.path(), options));
  EXPECT_EQ(played.names(), "color_9 color_10 color_11");
  EXPECT_EQ(played.frames[1].stamp, Timestamp(666'666'666));
  EXPECT_TRUE(any_has(played.source->describe(), "stamps: none, 15 Hz assumed (--rate)"));
  EXPECT_TRUE(any_has(played.warnings, "no time stamps: 15 Hz is assumed"));
  SourceOptions given = options;
  given.rate = 20.0;
  const Playback at_20_hz(open_dataset(folder.path(), given));
  EXPECT_EQ(at_20_hz.frames[1].stamp, Timestamp(500'000'000));
  EXPECT_TRUE(at_20_hz.warnings.empty());
}

TEST(TumRgbd, MatchesImagesByStampsInTheirNames) {
  const TempFolder folder;
  folder.write("calibration.yaml", kCalibration);
  for (const char* stamp : {"1305031102.175304", "1305031102.211214"}) {
    write_color(folder.path() / "rgb" / (std::string(stamp) + ".png"));
  }
  for (const char* stamp : {"1305031102.160407", "1305031102.226738"}) {
    write_depth(folder.path() / "depth" / (std::string(stamp) + ".png"));
  }
  const Playback played(open_dataset(folder.path()));
  EXPECT_EQ(played.names(), "1305031102.175304 1305031102.211214");
  EXPECT_EQ(played.frames[0].stamp, Timestamp(1'305'031'102'175'304'000));
  EXPECT_EQ(played.frames[0].depth_offset, Duration(-14'897'000));
}

TEST(TumRgbd, SkipsDamagedLines) {
  const TempFolder folder;
  write_tum(folder, 2);
  folder.write("rgb.txt", "5.0 rgb/f0.png\nx rgb/f1.png\n5.1\n5.1 rgb/f1.png\n");
  const Playback played(open_dataset(folder.path()));
  EXPECT_EQ(played.names(), "f0 f1");
  EXPECT_TRUE(
      any_has(played.warnings, "rgb.txt:2: line skipped, expected 'stamp path' (2 such lines)"));
}

TEST(TumRgbd, ReadsMasksAndReportsMissingOnce) {
  const TempFolder folder;
  write_tum(folder, 3);
  std::filesystem::create_directories(folder.path() / "masks");
  write_png(folder.path() / "masks/f0.png", Image<std::uint8_t>(kWidth, kHeight, 2));
  write_png(folder.path() / "masks/f2.png", Image<std::uint8_t>(3, 3, 2));
  const Playback played(open_dataset(folder.path()));
  EXPECT_EQ(played.names(), "f0 f1");
  EXPECT_EQ(played.frames[0].mask(3, 3), 2);
  EXPECT_TRUE(played.frames[1].mask.empty());
  ASSERT_EQ(played.warnings.size(), 2U);
  expect_in("only 2 of 3 frames have a mask, the first one missing is f1.png", played.warnings[0]);
  expect_in("frame f2 skipped: ", played.warnings[1]);
  expect_in("is 3x3 pixels", played.warnings[1]);
  EXPECT_EQ(Playback(open_dataset(folder.path(), {.masks = {}, .load_masks = false})).names(),
            "f0 f1 f2");
}

TEST(TumRgbd, ReadsMasksFromOtherFolder) {
  const TempFolder folder;
  write_tum(folder, 1);
  std::filesystem::create_directories(folder.path() / "other");
  const SourceOptions options{.masks = folder.path() / "other"};
  expect_in("has no mask for any frame", error_of(folder, options));
  write_png(options.masks / "f0.png", Image<std::uint8_t>(kWidth, kHeight, 1));
  EXPECT_EQ(Playback(open_dataset(folder.path(), options)).frames[0].mask(0, 0), 1);
}

TEST(TumRgbd, ErrorsNameMissingLists) {
  const TempFolder folder;
  write_tum(folder, 1);
  std::filesystem::remove(folder.path() / "depth.txt");
  expect_in("is a TUM-layout sequence, but depth.txt is missing", error_of(folder));
  std::filesystem::remove(folder.path() / "rgb.txt");
  std::filesystem::rename(folder.path() / "rgb/f0.png", folder.path() / "rgb/first.png");
  expect_in("rgb.txt and depth.txt are missing", error_of(folder));
  folder.write("depth.txt", "1 depth/f0.png\n");
  expect_in("but rgb.txt is missing", error_of(folder));
}

TEST(TumRgbd, RejectsListsWithoutMatches) {
  const TempFolder folder;
  write_tum(folder, 1);
  folder.write("depth.txt", "9.0 depth/f0.png\n");
  expect_in("of 1 color and 1 depth images, no two match within 0.02 s", error_of(folder));
  folder.write("depth.txt", "# nothing\n");
  expect_in("depth.txt: lists no images", error_of(folder));
}

TEST(TumRgbd, ErrorExplainsMissingCalibration) {
  const TempFolder folder;
  write_tum(folder, 1);
  std::filesystem::remove(folder.path() / "calibration.yaml");
  expect_in("add calibration.yaml with fx, fy, cx, cy, width, height", error_of(folder));
  folder.write("calibration.yaml", "fx: [oops\n");
  message_of<ConfigError>([&] { open_dataset(folder.path()); });
}

TEST(TumRgbd, ErrorNamesLineOfDamagedGroundTruth) {
  const TempFolder folder;
  write_tum(folder, 1);
  folder.write("groundtruth.txt", "5.0 1 2 3 0 0 0 1\n5.1 1 2\n");
  expect_in("groundtruth.txt:2: 3 columns, expected 8", error_of(folder));
}

TEST(TumCalibration, IsDerivedFromFolderName) {
  EXPECT_EQ(default_calibration("/d/rgbd_dataset_freiburg1_xyz")->camera->fx, 517.3);
  EXPECT_EQ(default_calibration("/d/FR2_desk/")->camera->fx, 520.9);
  EXPECT_EQ(default_calibration("fr3_walking")->camera->distortion, (std::array<double, 5>{}));
  EXPECT_EQ(default_calibration("fr3_walking")->depth_scale, 5000.0);
  EXPECT_EQ(default_calibration("/d/rgbd_bonn_crowd")->camera->fx, 542.822841);
  EXPECT_FALSE(default_calibration("/fr1/kitchen"));
}

TEST(TumRgbd, ReadsCalibrationOfEth3d) {
  const TempFolder folder;
  write_tum(folder, 1);
  std::filesystem::remove(folder.path() / "calibration.yaml");
  folder.write("calibration.txt", "10 11 4 3\n");
  const Frame frame = Playback(open_dataset(folder.path())).frames.at(0);
  EXPECT_EQ(frame.calibration->camera->fy, 11.0);
  EXPECT_EQ(frame.calibration->camera->width, kWidth);
  folder.write("rgb/f0.png", "damaged");
  write_color(folder.path() / "rgb/f1.png");
  write_depth(folder.path() / "depth/f1.png");
  folder.write("rgb.txt", "5.0 rgb/f0.png\n5.1 rgb/f1.png\n");
  folder.write("depth.txt", "5.0 depth/f0.png\n5.1 depth/f1.png\n");
  EXPECT_EQ(Playback(open_dataset(folder.path())).names(), "f1") << "f0 is damaged";
  EXPECT_NEAR(frame.depth(0, 0), 1500.0 / 5000.0, 1e-6);
  folder.write("calibration.txt", "10 11 4\n");
  expect_in("calibration.txt: has 3 numbers (expected fx fy cx cy", error_of(folder));
}

TEST(TumRgbd, ReadsListsOfOpenLoris) {
  const TempFolder folder;
  write_tum(folder, 2);
  std::filesystem::rename(folder.path() / "rgb.txt", folder.path() / "color.txt");
  std::filesystem::rename(folder.path() / "depth.txt", folder.path() / "aligned_depth.txt");
  std::filesystem::remove(folder.path() / "calibration.yaml");
  folder.write("sensors.yaml", R"(%YAML:1.0
---
d400_depth_optical_frame:
   intrinsics: !!opencv-matrix
      rows: 1
      cols: 4
      dt: d
      data: [ 1, 1, 1, 1 ]
d400_color_optical_frame:
   sensor_type: camera
   fps: 30
   width: 8
   height: 6
   model: pinhole
   intrinsics: !!opencv-matrix
      rows: 1
      cols: 4
      dt: d
      data: [ 10., 4., 11., 3. ]
   distortion_model: "radial-tangential"
   distortion_coefficients: !!opencv-matrix
      rows: 1
      cols: 5
      dt: d
      data: [ 0.1, 0., 0., 0., 0. ]
)");
  const Playback played(open_dataset(folder.path()));
  EXPECT_EQ(played.names(), "f0 f1");
  EXPECT_EQ(*played.source->calibration()->camera,
            (CameraIntrinsics{10, 11, 4, 3, 8, 6, {0.1, 0, 0, 0, 0}}));
}

/// ICL-NUIM numbers its images in place of stamps, and the y axis of its camera is up.
TEST(TumRgbd, ReadsIclNuim) {
  const TempFolder folder;
  std::string pairs;
  for (const char* name : {"0", "1"}) {
    const std::string file = std::string(name) + ".png";
    std::filesystem::create_directories(folder.path() / "rgb");
    std::filesystem::create_directories(folder.path() / "depth");
    write_png(folder.path() / "rgb" / file, Image<Rgb>(640, 480));
    write_png(folder.path() / "depth" / file, Image<std::uint16_t>(640, 480, 5000));
    pairs += std::string(name) + " depth/" + file + " " + name + " rgb/" + file + "\n";
  }
  folder.write("associations.txt", pairs);
  // 30 degrees about x.
  folder.write("livingRoom0.gt.freiburg", "0 0 0 0 0 0 0 1\n1 1 2 3 0.25881905 0 0 0.96592583\n");
  const Playback played(open_dataset(folder.path()));
  ASSERT_EQ(played.frames.size(), 2U);
  EXPECT_EQ(played.frames[1].stamp, Timestamp(33'333'333));
  EXPECT_EQ(played.frames[1].depth(0, 0), 1.0F);
  EXPECT_EQ(played.frames[1].calibration->camera->fy, 480.0);
  ASSERT_EQ(played.source->ground_truth().size(), 2U);
  const StampedPose& pose = played.source->ground_truth()[1];
  EXPECT_EQ(pose.stamp, played.frames[1].stamp);
  EXPECT_TRUE(pose.T_world_sensor.translation().isApprox(Eigen::Vector3d(1, -2, 3)));
  const Eigen::AngleAxisd back(-30.0 * M_PI / 180.0, Eigen::Vector3d::UnitX());
  EXPECT_TRUE(pose.T_world_sensor.isometry().linear().isApprox(back.toRotationMatrix(), 1e-6));
}

TEST(TumRgbd, ReadsSharedRecordings) {
  const std::filesystem::path shared =
      std::filesystem::path(MMS_SOURCE_DIR) / "../shared/data/rgbd";
  if (!std::filesystem::exists(shared)) GTEST_SKIP() << "no shared data";
  const auto source = open_dataset(shared / "lab_crowd");
  EXPECT_EQ(source->size(), 149U);
  const auto frame = source->next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->color.width(), 640);
  EXPECT_TRUE(frame->mask.same_size(frame->depth));
  EXPECT_EQ(open_dataset(shared / "fr1_xyz_clip")->ground_truth().empty(), false);
}

TEST(TumRgbd, RegistersDepthOfCameraOfItsOwn) {
  const TempFolder folder;
  write_tum(folder, 1);
  // The depth camera is 0.15 m to the left: at 1.5 m and 10 px of focal length 1 px.
  Image<std::uint16_t> depth(kWidth, kHeight, 1500);
  for (int y = 0; y < kHeight; ++y) depth(3, y) = 0;
  write_png(folder.path() / "depth" / file_of(0), depth);
  folder.write("calibration.yaml",
               kCalibration +
                   "depth_camera:\n  fx: 10\n  fy: 10\n  cx: 4\n  cy: 3\n  width: 8\n  height: 6\n"
                   "  T_color_depth: [1, 0, 0, -0.15, 0, 1, 0, 0, 0, 0, 1, 0]\n");
  const Playback played(open_dataset(folder.path()));
  ASSERT_EQ(played.frames.size(), 1U);
  EXPECT_TRUE(any_has(played.source->describe(), "registered to the color images"));
  const Frame& frame = played.frames[0];
  EXPECT_FALSE(frame.calibration->depth_camera);
  for (int x = 0; x < kWidth; ++x) EXPECT_EQ(frame.depth(x, 2), x == 2 || x == 7 ? 0.0F : 1.5F);
}

}  // namespace
}  // namespace mms
