#include "mms/segmentation/engine/network_engine.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include "mms/core/error.hpp"
#include "mms/segmentation/engine/engine_detector.hpp"
#include "tests/engine/engine_test_support.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms::engine {
namespace {

using testing::expect_in;
using testing::message_of;
using testing::random_image;
using testing::random_model;

std::vector<float> mask_features(NetworkEngine& engine, const PreparedImage& image) {
  const HeadMaps maps = engine.run(image);
  const int count = maps.mask_width * maps.mask_height * maps.mask_features.pitch;
  return {maps.mask_features.data, maps.mask_features.data + count};
}

TEST(NetworkEngine, HasMapsOfHeadSizes) {
  NetworkEngine engine(random_model({}, 1), "net", {});
  const HeadMaps maps = engine.run(random_image(96, 128, 1));
  EXPECT_EQ(maps.mask_height, 24);
  EXPECT_EQ(maps.mask_width, 32);
  EXPECT_EQ(maps.mask_features.pitch, 64);
  EXPECT_EQ(maps.categories[0].pitch, 2);
  EXPECT_EQ(maps.kernels[4].pitch, 64);
}

TEST(NetworkEngine, IsIndependentOfEarlierSizes) {
  NetworkEngine engine(random_model({}, 1), "net", {});
  const PreparedImage image = random_image(96, 128, 1);
  const std::vector<float> first = mask_features(engine, image);
  for (int side = 96; side <= 256; side += 32) engine.run(random_image(side, 96, 2));
  EXPECT_EQ(mask_features(engine, image), first);
}

TEST(NetworkEngine, SameResultForAnyThreadCount) {
  const NetworkConfig config =
      NetworkConfig::preset(NetworkSize::kNano, NetworkVariant::kDetectors);
  NetworkEngine engine(random_model(config, 1), "net", {});
  const PreparedImage image = random_image(96, 128, 1);
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const std::vector<float> one = mask_features(engine, image);
  omp_set_num_threads(2);
  EXPECT_EQ(mask_features(engine, image), one);
  omp_set_num_threads(before);
}

TEST(NetworkEngine, ErrorsExplainMismatch) {
  SegmentationModel incomplete = random_model({}, 1);
  incomplete.weights.tensors.erase("mask_head.conv_cls.bias");
  expect_in("net.file: misses the tensor mask_head.conv_cls.bias",
            message_of<DataError>([&] { NetworkEngine(incomplete, "net.file", {}); }));
  SegmentationModel deformable{
      NetworkConfig::preset(NetworkSize::kR50, NetworkVariant::kSac), {"person", "agv"}, {}};
  expect_in("deformable",
            message_of<DataError>([&] { NetworkEngine(deformable, "net.file", {}); }));
}

TEST(EngineDetector, AcceptsImagesOfAnySize) {
  EngineDetector detector(random_model({}, 1), "net", {}, {}, 1);
  EXPECT_EQ(detector.classes().size(), 2U);
  for (const auto& [width, height] : {std::pair{640, 480}, {1, 1}, {480, 640}, {2000, 50}}) {
    for (const Detection& detection : detector.detect(Image<Rgb>(width, height))) {
      EXPECT_LE(detection.x + detection.mask.width(), width);
      EXPECT_LE(detection.y + detection.mask.height(), height);
    }
  }
}

}  // namespace
}  // namespace mms::engine
