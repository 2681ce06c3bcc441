#include "mms/training/data/data_files.hpp"

#include "mms/core/error.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::expect_in;
using testing::message_of;
using testing::TempFolder;

constexpr const char* kAnnotations = R"({
  "categories": [{"id": 1, "name": "person"}, {"id": 7, "name": "agv"}, {"id": 9, "name": "box"}],
  "images": [{"id": 1, "file_name": "a.jpg", "width": 8, "height": 8},
             {"id": 2, "file_name": "b.jpg", "width": 8, "height": 8},
             {"id": 3, "file_name": "c.jpg", "width": 8, "height": 8}],
  "annotations": [
    {"id": 1, "image_id": 1, "category_id": 1, "iscrowd": 0, "area": 4, "bbox": [0, 0, 2, 2],
     "segmentation": [[0, 0, 2, 0, 2, 2, 0, 2]]},
    {"id": 2, "image_id": 2, "category_id": 7, "iscrowd": 0, "area": 4, "bbox": [0, 0, 2, 2],
     "segmentation": [[0, 0, 2, 0, 2, 2, 0, 2]]},
    {"id": 3, "image_id": 3, "category_id": 9, "iscrowd": 0, "area": 4, "bbox": [0, 0, 2, 2],
     "segmentation": [[0, 0, 2, 0, 2, 2, 0, 2]]}]})";

TEST(ListImages, SelectsImagesWithClass) {
  const TempFolder folder;
  TrainingData set;
  set.annotations = folder.write("all.json", kAnnotations).string();
  const std::vector<std::string> classes = {"person", "agv"};
  EXPECT_EQ(list_images(set, classes).size(), 3U);
  set.containing = "agv";
  const std::vector<DataImage> images = list_images(set, classes);
  ASSERT_EQ(images.size(), 1U);
  EXPECT_EQ(images[0].id, 2);
  EXPECT_EQ(images[0].objects.at(0).category, 1);
}

TEST(ListImages, ReadsBoxesAndIncompleteClasses) {
  const TempFolder folder;
  TrainingData set;
  set.annotations = folder
                        .write("all.json", R"({
    "categories": [{"id": 1, "name": "person"}, {"id": 7, "name": "agv"}],
    "images": [{"id": 1, "file_name": "a.jpg", "width": 8, "height": 6, "partial": ["person"]},
               {"id": 2, "file_name": "b.jpg", "width": 8, "height": 6}],
    "annotations": [
      {"id": 1, "image_id": 1, "category_id": 7, "iscrowd": 0, "area": 6, "bbox": [1, 2, 3, 2],
       "segmentation": [], "box_only": true}]})")
                        .string();
  const std::vector<DataImage> images = list_images(set, {"person", "agv"});
  ASSERT_EQ(images.size(), 2U);
  EXPECT_EQ(images[0].partial, std::vector<int>{0});
  EXPECT_TRUE(images[1].partial.empty());
  const Annotated& box = images[0].objects.at(0);
  EXPECT_TRUE(box.box_only);
  const Image<std::uint8_t> mask = decode_rle(box.segmentation);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 8; ++x) {
      EXPECT_EQ(mask(x, y) != 0, x >= 1 && x < 4 && y >= 2 && y < 4) << x << " " << y;
    }
  }
}

TEST(ListImages, ErrorsNameUnknownOrAbsentClass) {
  const TempFolder folder;
  TrainingData set;
  set.annotations = folder.write("all.json", kAnnotations).string();
  set.containing = "box";
  expect_in("'box' is none of the network's classes", message_of<ConfigError>([&] {
              list_images(set, {"person", "agv"});
            }));
  set.containing = "car";
  expect_in("has no images with the class 'car'", message_of<DataError>([&] {
              list_images(set, {"person", "car"});
            }));
}

}  // namespace
}  // namespace mms
