#include "mms/training/data/batch.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "mms/io/image/image_io.hpp"
#include "mms/training/run/training_run.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

TEST(MakeBatch, MayHaveTheShapeOfAnImage) {
  const testing::TempFolder folder;
  write_png(folder.path() / "a.png", Image<Rgb>(128, 64));
  TrainingConfig config;
  config.network.long_side = 256;
  config.network.short_side = 192;
  config.use_cuda = false;
  config.schedule.batch = 1;
  config.augmentation.portrait = 0.0;
  config.data = {{.images = folder.path().string()}};
  const SampleStore store(config.data, training_classes(), config.cache_side);
  const auto shape = [&] { return make_batch(store, config, 0).images.sizes().vec(); };
  EXPECT_EQ(shape(), (std::vector<std::int64_t>{1, 3, 192, 256}));
  config.augmentation.image_shapes = 1.0;
  EXPECT_EQ(shape(), (std::vector<std::int64_t>{1, 3, 128, 256}));
}

}  // namespace
}  // namespace mms
