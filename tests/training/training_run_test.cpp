#include "mms/training/run/training_run.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/weights/safetensors.hpp"
#include "mms/segmentation/network/inference.hpp"
#include "mms/segmentation/weights/model.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::expect_in;
using testing::message_of;
using testing::TempFolder;
namespace fs = std::filesystem;

/// Images with a bright vertical bar (person) or a dark horizontal one (agv) on grey.
void write_bars(const fs::path& folder, int images) {
  CocoDataset dataset;
  dataset.categories = {{1, "person"}, {2, "agv"}};
  fs::create_directories(folder / "images");
  for (int i = 0; i < images; ++i) {
    const bool person = i % 2 == 0;
    const int width = person ? 20 : 50;
    const int height = person ? 50 : 20;
    const int x = 8 + (i * 37) % (112 - width);
    const int y = 6 + (i * 23) % (84 - height);
    Image<Rgb> image(128, 96, Rgb{120, 120, 120});
    for (int v = y; v < y + height; ++v) {
      for (int u = x; u < x + width; ++u) image(u, v) = person ? Rgb{250, 60, 60} : Rgb{10, 90, 20};
    }
    const std::string name = std::to_string(i) + ".png";
    write_png(folder / "images" / name, image);
    dataset.images.push_back({.id = i, .file_name = name, .width = 128, .height = 96});
    dataset.annotations.push_back(
        coco_annotation(i + 1, i, person ? 1 : 2,
                        encode_rle(Image<std::uint8_t>(width, height, 1), x, y, 128, 96)));
  }
  write_coco(folder / "annotations.json", dataset);
}

TrainingConfig small_training(const fs::path& data, int images) {
  TrainingConfig config;
  config.network.long_side = 128;
  config.network.short_side = 96;
  config.network.head.object_scale = 20;
  config.network.head.grid_density = 0.4;
  config.data = {{.annotations = (data / "annotations.json").string()}};
  config.validation = config.data;
  config.half_precision = false;
  config.use_cuda = false;
  config.augmentation = {.scale_min = 1.0,
                         .scale_max = 1.0,
                         .flip = 0.5,
                         .portrait = 0,
                         .copy_paste = 0,
                         .color = 0,
                         .blur = 0,
                         .noise = 0,
                         .grey = 0};
  config.schedule = {.optimizer = Optimizer::kAdamW,
                     .images = images,
                     .batch = 4,
                     .learning_rate = 2e-3,
                     .warm_up = 5,
                     .ema = 0.9,
                     .frozen_stages = 0,
                     .kept_statistics = 0};
  return config;
}

/// With small simple images and random initial weights, the objects are detected after some steps.
TEST(TrainingRun, LearnsToFindBars) {
  const TempFolder folder;
  write_bars(folder.path(), 8);
  const TrainingConfig config = small_training(folder.path(), 480);
  TrainingRun run(config, folder.path() / "out", 2);
  std::vector<ApPoint> aps;
  std::vector<double> losses;
  run.on_event([&](const TrainingEvent& event) {
    if (event.kind == TrainingEvent::Kind::kValidation) aps = event.aps;
    if (event.kind == TrainingEvent::Kind::kStep) losses.push_back(event.loss.loss);
    return true;
  });
  EXPECT_TRUE(run.train());
  ASSERT_GE(losses.size(), 2U);
  EXPECT_LT(losses.back(), 0.5 * losses.front());
  ASSERT_EQ(aps.size(), 2U);
  for (const ApPoint& point : aps) EXPECT_GT(point.ap50, 0.9) << point.category;

  const SegmentationModel model =
      unpack_model(read_safetensors(run.weights_path()), run.weights_path().string());
  EXPECT_EQ(model.classes, (std::vector<std::string>{"person", "agv"}));
  network::SoloNetwork network(model.network);
  network::load_weights(*network, model.weights, "weights");
  network->eval();
  const auto found =
      network::detect(network, read_color(folder.path() / "images/0.png"), DecoderConfig());
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].category, 0);
  EXPECT_NEAR(found[0].x, 8, 4);
  EXPECT_NEAR(found[0].mask.height(), 50, 8);
  expect_in("<svg", read_file(run.report_path()));
}

/// Trains without interruption, or stops after some steps and resumes; returns the last loss.
double last_loss(const TrainingConfig& config, const fs::path& out, int stop_after) {
  double loss = 0.0;
  for (int start = 0; start < (stop_after > 0 ? 2 : 1); ++start) {
    TrainingRun run(config, out, 1);
    int steps = 0;
    run.on_event([&](const TrainingEvent& event) {
      if (event.kind != TrainingEvent::Kind::kStep) return true;
      loss = event.loss.loss;
      return start == 1 || stop_after == 0 || ++steps < stop_after;
    });
    EXPECT_EQ(run.train(), start == 1 || stop_after == 0);
  }
  return loss;
}

TEST(TrainingRun, ResumedTrainingEqualsUninterrupted) {
  const TempFolder folder;
  write_bars(folder.path(), 4);
  TrainingConfig config = small_training(folder.path(), 4 * 50);
  config.validation.clear();
  const double whole = last_loss(config, folder.path() / "whole", 0);
  const double resumed = last_loss(config, folder.path() / "resumed", 1);
  EXPECT_NEAR(resumed, whole, 1e-4 * whole);
}

TEST(TrainingRun, RejectsFolderOfOtherSettings) {
  const TempFolder folder;
  write_bars(folder.path(), 2);
  TrainingConfig config = small_training(folder.path(), 4);
  config.validation.clear();
  TrainingRun(config, folder.path() / "out", 1).train();
  config.schedule.learning_rate = 1e-5;
  expect_in("has a training with other settings",
            message_of<ConfigError>([&] { TrainingRun(config, folder.path() / "out", 1); }));
}

TEST(TrainingRun, ErrorNamesDamagedCheckpoint) {
  const TempFolder folder;
  write_bars(folder.path(), 2);
  TrainingConfig config = small_training(folder.path(), 4);
  config.validation.clear();
  TrainingRun(config, folder.path() / "out", 1).train();
  fs::resize_file(folder.path() / "out/checkpoint.pt", 1000);
  expect_in("checkpoint.pt: is not a checkpoint of this network",
            message_of<DataError>([&] { TrainingRun(config, folder.path() / "out", 1); }));
}

TEST(TrainingRun, ErrorsNameInvalidData) {
  const TempFolder folder;
  write_bars(folder.path(), 2);
  TrainingConfig config = small_training(folder.path(), 4);
  config.data[0].split = "train";
  config.validation.clear();
  expect_in("has no images in the split 'train'",
            message_of<DataError>([&] { TrainingRun(config, folder.path() / "out", 1).train(); }));
  config.data[0].split = "";
  write_png(folder.path() / "images/0.png", Image<Rgb>(64, 96));
  write_png(folder.path() / "images/1.png", Image<Rgb>(64, 96));
  expect_in("0.png: is 64x96, annotated as 128x96",
            message_of<DataError>([&] { TrainingRun(config, folder.path() / "out", 1).train(); }));
  config.data.clear();
  expect_in("data: is empty",
            message_of<ConfigError>([&] { TrainingRun(config, folder.path() / "out", 1); }));
}

}  // namespace
}  // namespace mms
