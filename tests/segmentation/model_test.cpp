#include "mms/segmentation/weights/model.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::expect_in;
using testing::message_of;

SegmentationModel sample_model() {
  SegmentationModel model;
  model.network = NetworkConfig::preset(NetworkSize::kR18, NetworkVariant::kDetectors);
  model.network.head.object_scale = 41.5;
  model.classes = {"person", "agv"};
  model.weights.tensors["a"] = {{2}, {1.0F, 2.0F}};
  return model;
}

TEST(Model, RoundTrips) {
  const SegmentationModel model = sample_model();
  const SegmentationModel back = unpack_model(pack_model(model), "file");
  EXPECT_EQ(back.classes, model.classes);
  EXPECT_EQ(back.network.variant, NetworkVariant::kDetectors);
  EXPECT_EQ(back.network.backbone.sac, SacMode::kPlain);
  EXPECT_EQ(back.network.head.object_scale, 41.5);
  EXPECT_EQ(back.weights.tensors, model.weights.tensors);
  EXPECT_EQ(pack_model(back), pack_model(model));
}

TEST(Model, FilesFromBeforeWindowsHaveNone) {
  Weights packed = pack_model(sample_model());
  packed.metadata.erase("network.head.window");
  packed.metadata.erase("network.head.level_norms");
  EXPECT_FALSE(unpack_model(packed, "file").network.head.window);
}

std::string error_of(const std::string& key, const std::string& value) {
  Weights packed = pack_model(sample_model());
  packed.metadata[key] = value;
  return message_of<DataError>([&] { unpack_model(packed, "file"); });
}

TEST(Model, ErrorsNameField) {
  expect_in("file: does not describe its network: missing 'network.size'",
            message_of<DataError>([] { unpack_model({}, "file"); }));
  expect_in("network.head.norm is 'x', expected one of gn, bn", error_of("network.head.norm", "x"));
  expect_in("network.neck.channels is '-5', expected an integer in [8, 512]",
            error_of("network.neck.channels", "-5"));
  expect_in("network.head.tower_depth is '2x'", error_of("network.head.tower_depth", "2x"));
  expect_in("names 3 classes, but its network has 2", error_of("classes", "a,b,c"));
}

}  // namespace
}  // namespace mms
