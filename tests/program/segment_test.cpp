#include <gtest/gtest.h>

#include "mms/io/image/coco_io.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/weights/safetensors.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/program/program.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using namespace testing;  // NOLINT: helpers of the tests

constexpr const char* kWeights = MMS_SOURCE_DIR "/weights/nano.safetensors";

TEST(Segment, FindsPeopleOfSimulation) {
  const TempFolder folder;
  const Outcome outcome = run_mms(folder.path(), {"segment", "sim:crowd?frames=3", "-o", "out"});
  expect_success(outcome);
  expect_in("out: 3 images, ", outcome.out);
  const CocoDataset images = read_coco(folder.path() / "out/images.json");
  ASSERT_EQ(images.images.size(), 3U);
  const std::vector<CocoResult> results = read_coco_results(folder.path() / "out/results.json");
  for (const CocoImage& image : images.images) {
    double best = 0.0;
    for (const CocoResult& result : results) {
      if (result.image_id == image.id && result.category_id == 1) {
        best = std::max(best, result.score);
      }
    }
    EXPECT_GT(best, 0.3) << image.file_name;
    const Image<std::uint8_t> mask = read_mask(folder.path() / "out/masks" / image.file_name);
    EXPECT_EQ(mask.width(), image.width);
    EXPECT_GT(std::count(mask.pixels().begin(), mask.pixels().end(), 1), 500);
  }
  EXPECT_EQ(list_folder(folder.path() / "out/overlays").size(), 3U);
}

TEST(Segment, KeepsIdsOfCocoFile) {
  const TempFolder folder;
  fs::create_directories(folder.path() / "data");
  CocoDataset dataset;
  dataset.categories = {{1, "person"}};
  for (const int id : {7, 9}) {
    const std::string name = std::to_string(id) + ".png";
    write_png(folder.path() / "data" / name, Image<Rgb>(160, 120, Rgb{90, 90, 90}));
    dataset.images.push_back({.id = id,
                              .file_name = name,
                              .width = 160,
                              .height = 120,
                              .split = id == 7 ? "train" : "holdout"});
  }
  write_coco(folder.path() / "truth.json", dataset);
  expect_success(run_mms(folder.path(), {"segment", "data", "--annotations", "truth.json",
                                         "--split", "holdout", "--json-only", "-o", "out"}));
  const CocoDataset images = read_coco(folder.path() / "out/images.json");
  ASSERT_EQ(images.images.size(), 1U);
  EXPECT_EQ(images.images[0].id, 9);
  EXPECT_FALSE(fs::exists(folder.path() / "out/masks"));
}

TEST(Segment, TakesCategoryIdsOfCocoFileByName) {
  const TempFolder folder;
  fs::create_directories(folder.path() / "data");
  write_png(folder.path() / "data/a.png", Image<Rgb>(160, 120, Rgb{90, 90, 90}));
  CocoDataset dataset;
  dataset.categories = {{1, "agv"}, {7, "person"}};
  dataset.images.push_back({.id = 1, .file_name = "a.png", .width = 160, .height = 120});
  write_coco(folder.path() / "truth.json", dataset);
  expect_success(run_mms(folder.path(), {"segment", "data", "--annotations", "truth.json",
                                         "--json-only", "-o", "out"}));
  const CocoDataset found = read_coco(folder.path() / "out/images.json");
  ASSERT_EQ(found.categories.size(), 2U);
  for (const CocoCategory& category : found.categories) {
    EXPECT_EQ(category.id, category.name == "person" ? 7 : 1);
  }
}

TEST(Segment, KeepsExtensionOfAmbiguousNames) {
  const TempFolder folder;
  fs::create_directories(folder.path() / "data");
  write_file(folder.path() / "data/a.jpg", encode_jpeg(Image<Rgb>(64, 48)));
  write_png(folder.path() / "data/a.png", Image<Rgb>(80, 60));
  write_png(folder.path() / "data/b.png", Image<Rgb>(96, 72));
  expect_success(run_mms(folder.path(), {"segment", "data", "-o", "out"}));
  EXPECT_EQ(list_folder(folder.path() / "out/masks"),
            (std::vector<std::string>{"a.jpg.png", "a.png.png", "b.png"}));
  EXPECT_EQ(list_folder(folder.path() / "out/overlays"),
            (std::vector<std::string>{"a.jpg.jpg", "a.png.jpg", "b.jpg"}));
  EXPECT_EQ(read_mask(folder.path() / "out/masks/a.jpg.png").width(), 64);
  EXPECT_EQ(read_mask(folder.path() / "out/masks/a.png.png").width(), 80);
  const CocoDataset images = read_coco(folder.path() / "out/images.json");
  ASSERT_EQ(images.images.size(), 3U);
  EXPECT_EQ(images.images[1].file_name, "a.png");
}

/// Images of one name in two folders, and one with the name that an extension would give.
TEST(Segment, NumbersImagesOfEqualName) {
  const TempFolder folder;
  CocoDataset dataset;
  dataset.categories = {{1, "person"}};
  for (const std::string name : {"x/a.png", "y/a.png", "a.png.png"}) {
    fs::create_directories((folder.path() / "data" / name).parent_path());
    write_png(folder.path() / "data" / name, Image<Rgb>(64, 48));
    const auto id = static_cast<std::int64_t>(dataset.images.size());
    dataset.images.push_back({.id = id, .file_name = name, .width = 64, .height = 48});
  }
  write_coco(folder.path() / "truth.json", dataset);
  expect_success(
      run_mms(folder.path(), {"segment", "data", "--annotations", "truth.json", "-o", "out"}));
  EXPECT_EQ(list_folder(folder.path() / "out/masks"),
            (std::vector<std::string>{"a.png-2.png", "a.png-3.png", "a.png.png"}));
}

/// `mms segment` with a weights file of these bytes.
Outcome segment_with(const TempFolder& folder, const std::string& bytes) {
  folder.write("bad.safetensors", bytes);
  write_png(folder.path() / "picture.png", Image<Rgb>(64, 48));
  return run_mms(folder.path(),
                 {"segment", "picture.png", "--weights", "bad.safetensors", "-o", "out"});
}

TEST(Segment, DamagedWeightsAreOneLineError) {
  const TempFolder folder;
  const std::string valid = read_file(kWeights);
  expect_error(segment_with(folder, ""), "bad.safetensors: ");
  expect_error(segment_with(folder, valid.substr(0, 100)), "bad.safetensors: ");
  expect_error(segment_with(folder, valid.substr(0, valid.size() - 7)), "bad.safetensors: ");
  expect_error(segment_with(folder, std::string(64, '\xff')), "bad.safetensors: ");
  expect_error(segment_with(folder, "<html>not found</html>"), "bad.safetensors: ");
}

TEST(Segment, WeightsOfOtherNetworkAreOneLineError) {
  const TempFolder folder;
  Weights weights = read_safetensors(kWeights);
  weights.tensors.erase("neck.fpn_convs.1.conv.weight");
  write_safetensors(folder.path() / "made.safetensors", weights);
  expect_error(segment_with(folder, read_file(folder.path() / "made.safetensors")),
               "misses the tensor neck.fpn_convs.1.conv.weight");
  weights.metadata.clear();
  write_safetensors(folder.path() / "made.safetensors", weights);
  expect_error(segment_with(folder, read_file(folder.path() / "made.safetensors")),
               "does not describe its network");
}

TEST(Segment, MissingFilesAreOneLineErrors) {
  const TempFolder folder;
  expect_error(run_mms(folder.path(), {"segment", "none", "-o", "out"}), "none: no such recording");
  write_png(folder.path() / "picture.png", Image<Rgb>(64, 48));
  expect_error(run_mms(folder.path(),
                       {"segment", "picture.png", "--weights", "no.safetensors", "-o", "out"}),
               "no.safetensors: ");
  folder.write("broken.json", "{\"images\": [");
  expect_error(
      run_mms(folder.path(), {"segment", ".", "--annotations", "broken.json", "-o", "out"}),
      "broken.json: ");
}

TEST(Import, ErrorNamesMissingTensors) {
  const TempFolder folder;
  Weights weights;
  weights.tensors["conv1.weight"] = {{1}, {0.0F}};
  write_safetensors(folder.path() / "other.safetensors", weights);
  expect_error(run_mms(folder.path(), {"import", "other.safetensors", "-o", "out.safetensors"}),
               "other.safetensors: ");
  EXPECT_FALSE(fs::exists(folder.path() / "out.safetensors"));
}

}  // namespace
}  // namespace mms
