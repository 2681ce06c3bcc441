#include "mms/training/data/data_files.hpp"

#include <filesystem>

#include "mms/core/error.hpp"
#include "mms/training/data/sample_store.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
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
  AnnotationFiles files;
  set.annotations = folder.write("all.json", kAnnotations).string();
  const std::vector<std::string> classes = {"person", "agv"};
  EXPECT_EQ(list_images(set, classes, files).size(), 3U);
  set.containing = "agv";
  const std::vector<DataImage> images = list_images(set, classes, files);
  ASSERT_EQ(images.size(), 1U);
  EXPECT_EQ(images[0].id, 2);
  EXPECT_EQ(images[0].objects.at(0).category, 1);
}

TEST(ListImages, ReadsBoxesAndIncompleteClasses) {
  const TempFolder folder;
  TrainingData set;
  AnnotationFiles files;
  set.annotations = folder
                        .write("all.json", R"({
    "categories": [{"id": 1, "name": "person"}, {"id": 7, "name": "agv"}],
    "images": [{"id": 1, "file_name": "a.jpg", "width": 8, "height": 6, "partial": ["person"]},
               {"id": 2, "file_name": "b.jpg", "width": 8, "height": 6}],
    "annotations": [
      {"id": 1, "image_id": 1, "category_id": 7, "iscrowd": 0, "area": 6, "bbox": [1, 2, 3, 2],
       "segmentation": [], "box_only": true}]})")
                        .string();
  const std::vector<DataImage> images = list_images(set, {"person", "agv"}, files);
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

constexpr const char* kWithFaults = R"({
  "categories": [{"id": 1, "name": "person"}, {"id": 7, "name": "agv"}],
  "images": [{"id": 1, "file_name": "a.jpg", "width": 8, "height": 6},
             {"id": 2, "file_name": "b.jpg", "width": 8, "height": 6},
             {"id": 3, "file_name": "c.jpg", "width": 0, "height": 6}],
  "annotations": [
    {"id": 1, "image_id": 1, "category_id": 7, "area": 6, "bbox": [1, 2, 3, 2],
     "segmentation": [], "box_only": true},
    {"id": 2, "image_id": 1, "category_id": 1, "area": 6, "bbox": [5, 2, 6, 2],
     "segmentation": [], "box_only": true},
    {"id": 3, "image_id": 2, "category_id": 1, "area": 0, "bbox": [5, 2, 0, 2],
     "segmentation": [], "box_only": true},
    {"id": 4, "image_id": 2, "category_id": 1, "area": 6, "bbox": [4, 2, 4.8, 2],
     "segmentation": [], "box_only": true},
    {"id": 5, "image_id": 2, "category_id": 7, "area": 6, "bbox": [1, 1, 3, 2],
     "segmentation": [], "box_only": true},
    {"id": 6, "image_id": 3, "category_id": 1, "area": 6, "bbox": [1, 1, 3, 2],
     "segmentation": [], "box_only": true}]})";

TEST(ListImages, LeavesOutFaultyEntries) {
  const TempFolder folder;
  TrainingData set;
  AnnotationFiles files;
  set.annotations = folder.write("all.json", kWithFaults).string();
  const std::vector<DataImage> images = list_images(set, {"person", "agv"}, files);
  ASSERT_EQ(images.size(), 2U);
  EXPECT_EQ(images[0].objects.size(), 1U);
  EXPECT_EQ(images[1].objects.size(), 2U);  // a box may exceed the image by a pixel
  // What lost its annotation is not trained as background.
  EXPECT_EQ(images[0].partial, (std::vector<int>{0, 1}));
  EXPECT_EQ(images[1].partial, (std::vector<int>{0, 1}));
  ASSERT_EQ(files.faults().images.size(), 1U);
  expect_in("all.json: images[2].width: is 0", files.faults().images[0]);
  ASSERT_EQ(files.faults().annotations.size(), 2U);  // that of the image is not another one
  expect_in("annotations[1].bbox: is [5, 2, 6, 2], outside of its image a.jpg of 8 x 6 px",
            files.faults().annotations[0]);
  expect_in("annotations[2]: has no area", files.faults().annotations[1]);
}

TEST(ListImages, ReadsTheFileOfSeveralSetsOnce) {
  const TempFolder folder;
  TrainingData set;
  AnnotationFiles files;
  set.annotations = folder.write("all.json", kWithFaults).string();
  const std::size_t images = list_images(set, {"person", "agv"}, files).size();
  fs::remove(set.annotations);
  set.containing = "agv";
  EXPECT_LE(list_images(set, {"person", "agv"}, files).size(), images);
  EXPECT_EQ(files.faults().images.size(), 1U);
  EXPECT_EQ(files.faults().annotations.size(), 2U);
}

TEST(ListImages, RefusesMostlyFaultySet) {
  const TempFolder folder;
  TrainingData set;
  AnnotationFiles files;
  set.annotations = folder
                        .write("bad.json", R"({
    "categories": [{"id": 1, "name": "person"}],
    "images": [{"id": 1, "file_name": "a.jpg", "width": 8, "height": 6}],
    "annotations": [
      {"id": 1, "image_id": 1, "category_id": 3, "area": 6, "bbox": [1, 2, 3, 2],
       "segmentation": [], "box_only": true},
      {"id": 2, "image_id": 5, "category_id": 1, "area": 6, "bbox": [1, 2, 3, 2],
       "segmentation": [], "box_only": true},
      {"id": 3, "image_id": 1, "category_id": 1, "area": 6, "bbox": [1, 2, 3, 2],
       "segmentation": [], "box_only": true}]})")
                        .string();
  expect_in("bad.json: 2 of 3 annotations cannot be used, allowed: at most half; first: ",
            message_of<DataError>([&] {
              list_images(set, {"person", "agv"}, files);
            }));
}

TEST(SampleStore, LeavesOutUnreadableImages) {
  const TempFolder folder;
  fs::create_directory(folder.path() / "images");
  for (const char* name : {"a.png", "b.png"}) {
    write_png(folder.path() / "images" / name, Image<Rgb>(8, 6));
  }
  folder.write("images/c.png", "no image");
  TrainingData set;
  set.annotations = folder
                        .write("all.json", R"({
    "categories": [{"id": 1, "name": "person"}],
    "images": [{"id": 1, "file_name": "images/a.png", "width": 8, "height": 6},
               {"id": 2, "file_name": "images/b.png", "width": 9, "height": 6},
               {"id": 3, "file_name": "images/c.png", "width": 8, "height": 6},
               {"id": 4, "file_name": "images/a.png", "width": 8, "height": 6}],
    "annotations": []})")
                        .string();
  const SampleStore store({set}, {"person", "agv"}, 480);
  EXPECT_EQ(store.size(), 2U);
  ASSERT_EQ(store.faults().images.size(), 2U);
  expect_in("b.png: is 8x6, annotated as 9x6", store.faults().images[0]);
  expect_in("c.png", store.faults().images[1]);
  fs::remove(folder.path() / "images" / "a.png");
  expect_in("all.json: 4 of 4 images cannot be used", message_of<DataError>([&] {
              const SampleStore none({set}, {"person", "agv"}, 480);
            }));
}

TEST(ListImages, ErrorsNameUnknownOrAbsentClass) {
  const TempFolder folder;
  TrainingData set;
  AnnotationFiles files;
  set.annotations = folder.write("all.json", kAnnotations).string();
  set.containing = "box";
  expect_in("'box' is none of the network's classes", message_of<ConfigError>([&] {
              list_images(set, {"person", "agv"}, files);
            }));
  set.containing = "car";
  expect_in("has no images with the class 'car'", message_of<DataError>([&] {
              list_images(set, {"person", "car"}, files);
            }));
}

}  // namespace
}  // namespace mms
