#include "mms/io/image/coco_io.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "mms/core/error.hpp"
#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/support/memory_limit.hpp"

namespace mms {
namespace {

using testing::expect_in;
using testing::message_of;
using testing::TempFolder;

const Rle kMask{4, 3, {3, 3, 2, 1, 3}};

CocoDataset sample() {
  CocoDataset dataset;
  dataset.images = {{7, "rgb/a \"b\".jpg", 4, 3}, {8, "b.jpg", 4, 3}};
  dataset.categories = {{1, "person"}, {2, "agv"}};
  dataset.annotations = {coco_annotation(1, 7, 2, kMask)};
  dataset.annotations[0].iscrowd = true;
  return dataset;
}

/// A file with one image of 4 x 3, one category and that annotation as JSON.
std::string with_annotation(const std::string& annotation) {
  return R"({"info": {}, "images": [{"id": 7, "file_name": "a", "width": 4, "height": 3}],)"
         R"("categories": [{"id": 1, "name": "person", "supercategory": "x"}],)"
         R"("annotations": [)" +
         annotation + "]}";
}

std::string annotation(const std::string& segmentation, const std::string& more = "",
                       const std::string& ids = R"("image_id": 7, "category_id": 1)") {
  return R"({"id": 5, "bbox": [1, 0, 2, 3], "area": 4.5, "segmentation": )" + segmentation + ", " +
         ids + more + "}";
}

std::string error_of(const std::string& content) {
  const TempFolder folder;
  const auto path = folder.write("a.json", content);
  const std::string message = message_of<DataError>([&] { read_coco(path); });
  expect_in(path.string() + ": ", message);
  return message;
}

TEST(CocoIo, RoundTrips) {
  const TempFolder folder;
  const auto path = folder.path() / "a.json";
  write_coco(path, sample());
  const CocoDataset read = read_coco(path);
  ASSERT_EQ(read.images.size(), 2U);
  EXPECT_EQ(read.images[0].file_name, "rgb/a \"b\".jpg");
  EXPECT_EQ(read.categories[1].name, "agv");
  ASSERT_EQ(read.annotations.size(), 1U);
  EXPECT_EQ(read.annotations[0].segmentation, kMask);
  EXPECT_EQ(read.annotations[0].bbox, (std::array{1.0, 0.0, 2.0, 3.0}));
  EXPECT_EQ(read.annotations[0].area, 4.0);
  EXPECT_TRUE(read.annotations[0].iscrowd);
  write_coco(folder.path() / "b.json", read);
  EXPECT_EQ(read_file(folder.path() / "b.json"), read_file(path));
}

TEST(CocoIo, KeepsSplitOfImage) {
  const TempFolder folder;
  CocoDataset dataset = sample();
  dataset.images[0].split = "holdout";
  const auto path = folder.path() / "a.json";
  write_coco(path, dataset);
  const CocoDataset read = read_coco(path);
  EXPECT_EQ(read.images[0].split, "holdout");
  EXPECT_EQ(read.images[1].split, "");
  write_coco(folder.path() / "b.json", sample());
  EXPECT_EQ(read_file(folder.path() / "b.json").find("split"), std::string::npos);
  expect_in("images[0].split: is a number, expected a string",
            error_of(R"({"images": [{"id": 7, "file_name": "a", "width": 4, "height": 3,)"
                     R"("split": 3}], "categories": [], "annotations": []})"));
}

TEST(CocoIo, EmptyDatasetRoundTrips) {
  const TempFolder folder;
  write_coco(folder.path() / "a.json", {});
  EXPECT_TRUE(read_coco(folder.path() / "a.json").images.empty());
}

TEST(CocoIo, ReadsEveryKindOfMask) {
  const TempFolder folder;
  for (const char* segmentation :
       {R"({"size": [3, 4], "counts": "332N1"})", R"({"size": [3, 4], "counts": [3, 3, 2, 1, 3]})",
        "[[1, 0, 2, 0, 2, 3, 1, 3], [2, 2, 3, 2, 3, 3, 2, 3]]"}) {
    const auto path = folder.write("a.json", with_annotation(annotation(segmentation)));
    EXPECT_EQ(read_coco(path).annotations[0].segmentation, kMask) << segmentation;
    EXPECT_FALSE(read_coco(path).annotations[0].iscrowd);
  }
}

TEST(CocoIo, ErrorsNameEntry) {
  const std::string valid = R"({"size": [3, 4], "counts": [12]})";
  expect_in("is not JSON: parse error at line 1", error_of("{"));
  expect_in("is a list, as of results", error_of("[]"));
  expect_in("missing key 'images'", error_of("{}"));
  expect_in("images: is a number, expected a list", error_of(R"({"images": 3})"));
  expect_in("annotations[0]: is a number, expected an object", error_of(with_annotation("3")));
  expect_in("annotations[0].segmentation.counts: mask: its runs have 11 pixels",
            error_of(with_annotation(annotation(R"({"size": [3, 4], "counts": [11]})"))));
  expect_in("annotations[0].segmentation.counts[0]: is -1, allowed: 0 to",
            error_of(with_annotation(annotation(R"({"size": [3, 4], "counts": [-1]})"))));
  expect_in("annotations[0].segmentation: has 3 x 4 px, its image 7 has 4 x 3",
            error_of(with_annotation(annotation(R"({"size": [4, 3], "counts": [12]})"))));
  expect_in("segmentation.size: is not a list of height and width",
            error_of(with_annotation(annotation(R"({"size": [4], "counts": [12]})"))));
  expect_in("segmentation: polygon: has 2 numbers",
            error_of(with_annotation(annotation("[[1, 2]]"))));
  expect_in("annotations[0].image_id: is 9, no such image",
            error_of(with_annotation(annotation(valid, "", R"("image_id": 9, "category_id": 1)"))));
  expect_in("annotations[0].category_id: is 3, no such category",
            error_of(with_annotation(annotation(valid, "", R"("image_id": 7, "category_id": 3)"))));
  expect_in("annotations[0].iscrowd: is 2, allowed: 0 to 1",
            error_of(with_annotation(annotation(valid, R"(, "iscrowd": 2)"))));
  expect_in("annotations[1].id: is 5, a duplicate",
            error_of(with_annotation(annotation(valid) + "," + annotation(valid))));
}

TEST(CocoIo, RefusesMasksThatTakeTooMuchMemory) {
  const testing::MemoryLimit limit;
  expect_in(
      "has an outline of",
      error_of(with_annotation(annotation("[[-1e6, -1e6, 1e6, 1e6, -1e6, 1e6, 1e6, -1e6]]"))));
  std::string large = with_annotation(annotation("[[1, 0, 2, 0, 2, 3], [2, 2, 3, 2, 3, 3]]"));
  const std::string size = R"("width": 4, "height": 3)";
  large.replace(large.find(size), size.size(), R"("width": 65535, "height": 65535)");
  expect_in("pixels, allowed: up to", error_of(large));
}

TEST(CocoIo, ResultsRoundTrip) {
  const TempFolder folder;
  const auto path = folder.path() / "results.json";
  write_coco_results(path, {{7, 1, 0.25, kMask}});
  const std::vector<CocoResult> read = read_coco_results(path);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].image_id, 7);
  EXPECT_EQ(read[0].score, 0.25);
  EXPECT_EQ(read[0].segmentation, kMask);
  expect_in("[0].score: is 2, allowed: 0 to 1", message_of<DataError>([&] {
              write_coco_results(path, {{7, 1, 2.0, kMask}});
              read_coco_results(path);
            }));
  write_coco(path, sample());
  expect_in("is not a list of results", message_of<DataError>([&] { read_coco_results(path); }));
}

TEST(CocoIo, WriterEqualsSingleCall) {
  const TempFolder folder;
  const std::vector<CocoResult> all = {{7, 1, 0.25, kMask}, {7, 2, 0.5, kMask}, {9, 1, 1.0, kMask}};
  for (std::size_t count = 0; count <= all.size(); ++count) {
    const std::vector<CocoResult> some(all.begin(), all.begin() + static_cast<int>(count));
    write_coco_results(folder.path() / "a.json", some);
    CocoResultsWriter writer(folder.path() / "b.json");
    for (const CocoResult& result : some) writer.add(result);
    writer.finish();
    EXPECT_EQ(read_file(folder.path() / "b.json"), read_file(folder.path() / "a.json"));
    EXPECT_EQ(read_coco_results(folder.path() / "b.json").size(), count);
  }
}

TEST(CocoIo, UnfinishedResultsLeaveNoFile) {
  const TempFolder folder;
  { CocoResultsWriter(folder.path() / "a.json").add({7, 1, 0.25, kMask}); }
  EXPECT_TRUE(list_folder(folder.path()).empty());
}

/// The reference files beside the checkout.
std::filesystem::path shared_coco(const char* file) {
  return std::filesystem::path(MMS_SOURCE_DIR) / "../shared/data/coco_eval" / file;
}

TEST(CocoIo, ReadsReferenceAnnotations) {
  const auto path = shared_coco("instances_val2014_100.json");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no shared data";
  const CocoDataset dataset = read_coco(path);
  EXPECT_EQ(dataset.images.size(), 100U);
  EXPECT_EQ(dataset.annotations.size(), 839U);
  int crowds = 0;
  double pixels = 0.0;
  double area = 0.0;
  for (const CocoAnnotation& annotation : dataset.annotations) {
    const std::array<double, 4> box = rle_box(annotation.segmentation);
    for (std::size_t axis = 0; axis < 2; ++axis) {  // pixels do not exceed the corners
      EXPECT_GE(box[axis], annotation.bbox[axis] - 1.0) << annotation.id;
      EXPECT_LE(box[axis] + box[axis + 2], annotation.bbox[axis] + annotation.bbox[axis + 2] + 1.0)
          << annotation.id;
    }
    if (annotation.iscrowd) {
      ++crowds;
    } else {  // the file has the area of the polygons before rasterization
      pixels += static_cast<double>(rle_area(annotation.segmentation));
      area += annotation.area;
    }
  }
  EXPECT_EQ(crowds, 9);
  EXPECT_NEAR(pixels / area, 1.0, 0.01);
}

TEST(CocoIo, ReadsReferenceResults) {
  const auto path = shared_coco("instances_val2014_fakesegm100_results.json");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no shared data";
  const std::vector<CocoResult> results = read_coco_results(path);
  EXPECT_EQ(results.size(), 734U);
  const std::string file = read_file(path);
  for (const CocoResult& result : results) {  // our text equals theirs
    nlohmann::json quoted = rle_to_string(result.segmentation);
    EXPECT_NE(file.find(quoted.dump()), std::string::npos);
  }
}

}  // namespace
}  // namespace mms
