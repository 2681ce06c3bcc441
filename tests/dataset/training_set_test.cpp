#include "mms/dataset/simulated/training_set.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using namespace testing;  // NOLINT: helpers of the tests

TrainingSetOptions options_for(int images, std::uint64_t seed = 5) {
  TrainingSetOptions options;
  options.images = images;
  options.seed = seed;
  return options;
}

TEST(TrainingSet, WritesImagesAndAnnotations) {
  const TempFolder folder;
  const WrittenTrainingSet written = write_training_set(folder.path() / "set", options_for(2));
  EXPECT_EQ(written.images, 2);
  EXPECT_EQ(written.fresh, 2);
  const CocoDataset dataset = read_coco(folder.path() / "set/annotations.json");
  ASSERT_EQ(dataset.images.size(), 2U);
  EXPECT_EQ(dataset.images[1].file_name, "images/000001.jpg");
  EXPECT_EQ(dataset.annotations.size(), written.annotations);
  for (const CocoImage& image : dataset.images) {
    EXPECT_EQ(read_color(folder.path() / "set" / image.file_name).height(), image.height);
  }
}

TEST(TrainingSet, ResumesInterruptedWriting) {
  const TempFolder folder;
  TrainingSetOptions options = options_for(2);
  options.progress = [](int done, int) { return done < 1; };
  EXPECT_EQ(write_training_set(folder.path() / "a", options).images, 1);
  EXPECT_EQ(read_coco(folder.path() / "a/annotations.json").images.size(), 1U);
  fs::remove(folder.path() / "a/images/000000.jpg");
  EXPECT_EQ(write_training_set(folder.path() / "a", options_for(2)).fresh, 2);
  write_training_set(folder.path() / "b", options_for(2));
  for (const char* file : {"annotations.json", "images/000000.jpg", "images/000001.jpg"}) {
    EXPECT_EQ(read_file(folder.path() / "a" / file), read_file(folder.path() / "b" / file));
  }
}

TEST(TrainingSet, ErrorsNameConflicts) {
  const TempFolder folder;
  write_training_set(folder.path() / "set", options_for(1));
  expect_in("training_set.json: has seed 5, not 6 (use the same --seed", message_of<DataError>([&] {
              write_training_set(folder.path() / "set", options_for(1, 6));
            }));
  folder.write("other/holiday.jpg", "x");
  expect_in("is not empty (it has holiday.jpg) and not a training set", message_of<FileError>([&] {
              write_training_set(folder.path() / "other", options_for(1));
            }));
  folder.write("set/parts/000000.json", "{");
  expect_in("000000.json: is not JSON", message_of<DataError>([&] {
              write_training_set(folder.path() / "set", options_for(1));
            }));
}

}  // namespace
}  // namespace mms
