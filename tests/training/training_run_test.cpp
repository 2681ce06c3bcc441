#include "mms/training/run/training_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mms/core/error.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/weights/safetensors.hpp"
#include "mms/segmentation/network/inference.hpp"
#include "mms/segmentation/weights/model.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/training/bars.hpp"

namespace mms {
namespace {

using testing::expect_in;
using testing::message_of;
using testing::small_training;
using testing::TempFolder;
using testing::write_bars;
namespace fs = std::filesystem;

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

TEST(TrainingRun, StopsAfterAStepAndContinues) {
  const TempFolder folder;
  write_bars(folder.path(), 4);
  TrainingConfig config = small_training(folder.path(), 4 * 5);
  config.validation.clear();
  int asked = 0;
  {
    TrainingRun stopped(config, folder.path() / "out", 1, {}, [&] { return ++asked == 2; });
    EXPECT_FALSE(stopped.train());
    const std::string weights = stopped.weights_path().string();
    EXPECT_NO_THROW(unpack_model(read_safetensors(weights), weights));
  }
  EXPECT_EQ(asked, 2);
  asked = 0;
  TrainingRun rest(config, folder.path() / "out", 1, {}, [&] { return ++asked < 0; });
  EXPECT_TRUE(rest.train());
  EXPECT_EQ(asked, config.schedule.images / config.schedule.batch - 2);
}

/// Weights before and after a training of some layers.
struct TwoWeights {
  Weights before;
  Weights after;
};

TwoWeights train_some(TrainedLayers trained, bool window) {
  const TempFolder folder;
  write_bars(folder.path(), 4);
  TrainingConfig config = small_training(folder.path(), 8);
  config.validation.clear();
  TrainingRun plain(config, folder.path() / "plain", 1);
  plain.train();
  config.initial_weights = plain.weights_path().string();
  config.network.head.window = window;
  config.schedule.trained = trained;
  TrainingRun run(config, folder.path() / "some", 1);
  run.train();
  return {read_safetensors(plain.weights_path()), read_safetensors(run.weights_path())};
}

TEST(TrainingRun, KernelsOnlyAddsWindowAndKeepsAllOtherWeights) {
  const auto [before, after] = train_some(TrainedLayers::kKernels, true);
  const std::string kernels = "mask_head.conv_kernel.";
  for (const auto& [name, tensor] : after.tensors) {
    if (name.starts_with(kernels)) continue;
    EXPECT_EQ(tensor, before.tensors.at(name)) << name;
  }
  const std::vector<float>& old_bias = before.tensors.at(kernels + "bias").values;
  const std::vector<float>& bias = after.tensors.at(kernels + "bias").values;
  ASSERT_EQ(bias.size(), old_bias.size() + HeadConfig::kWindowTerms);
  EXPECT_FALSE(std::equal(old_bias.begin(), old_bias.end(), bias.begin()));
}

TEST(TrainingRun, HeadOnlyKeepsBackboneAndPyramid) {
  const auto [before, after] = train_some(TrainedLayers::kHead, false);
  for (const auto& [name, tensor] : after.tensors) {
    if (name.starts_with("mask_head.")) continue;
    EXPECT_EQ(tensor, before.tensors.at(name)) << name;
  }
  for (const char* name : {"mask_head.conv_cls.weight", "mask_head.conv_kernel.weight"}) {
    EXPECT_FALSE(after.tensors.at(name) == before.tensors.at(name)) << name;
  }
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
