#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>

#include "mms/evaluation/segmentation/segmentation_error.hpp"
#include "tests/evaluation/coco_cases.hpp"
#include "tests/evaluation/naive_coco.hpp"

namespace mms {
namespace {

using test::add_person;
using test::box;
using test::empty_truth;
using test::expect_scores;
using Results = std::vector<CocoResult>;

std::vector<double> numbers(const SegmentationScores& scores) {
  std::vector<double> numbers;
  for (const MetricValue& value : metric_values(scores)) numbers.push_back(value.value);
  return numbers;
}

/// Truth and results of boxes of all sizes with rectangles cut out, with crowds and equal scores.
class RandomScene {
 public:
  RandomScene(unsigned seed, int size) : random_(seed), size_(size), truth_(empty_truth(4, size)) {
    truth_.categories = {{5, "agv"}, {1, "person"}, {9, "ghost"}};
    std::shuffle(truth_.images.begin(), truth_.images.end(), random_);
  }

  CocoDataset truth(int objects) {
    for (int i = 0; i < objects; ++i) {
      CocoAnnotation& object = add_person(truth_, random_upto(3) + 1, mask());
      object.category_id = random_upto(1) == 0 ? 1 : 5;
      object.iscrowd = random_upto(5) == 0;
      object.area *= 0.1 * (random_upto(4) + 8);
    }
    return truth_;
  }

  Results results(int count) {
    Results results;
    for (int i = 0; i < count; ++i) {
      CocoResult result = {random_upto(3) + 1, random_upto(9) == 0 ? 9 : 1, 0.1 * random_upto(10),
                           mask()};
      if (random_upto(4) != 0) {  // nearly equal to one of the objects
        const auto last = static_cast<int>(truth_.annotations.size()) - 1;
        const CocoAnnotation& object =
            truth_.annotations[static_cast<std::size_t>(random_upto(last))];
        result.image_id = object.image_id;
        result.category_id = object.category_id;
        result.segmentation = with_cutout(decode_rle(object.segmentation));
      }
      results.push_back(result);
    }
    return results;
  }

 private:
  int random_upto(int last) { return std::uniform_int_distribution(0, last)(random_); }

  Rle mask() {
    const int w = random_upto(size_);
    const int h = random_upto(size_);
    const Rle whole = box(random_upto(size_ - w), random_upto(size_ - h), w, h, size_);
    return with_cutout(decode_rle(whole));
  }

  Rle with_cutout(Image<std::uint8_t> mask) {
    const int x = random_upto(size_ - 1);
    const int y = random_upto(size_ - 1);
    const int cutout = random_upto(size_ / 3);
    for (int v = y; v < std::min(size_, y + cutout); ++v) {
      for (int u = x; u < std::min(size_, x + cutout); ++u) mask(u, v) = 0;
    }
    return encode_rle(mask);
  }

  std::mt19937 random_;
  int size_;
  CocoDataset truth_;
};

void expect_as_naive(unsigned seed, int size, int objects, int count) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  RandomScene scene(seed, size);
  const CocoDataset truth = scene.truth(objects);
  const Results results = scene.results(count);
  expect_scores(segmentation_error(truth, results).all,
                numbers(test::naive_scores(truth, results)));
}

TEST(SegmentationReference, EqualsNaiveReference) {
  for (unsigned seed = 0; seed < 4; ++seed) expect_as_naive(seed, 110, 12, 30);
  for (unsigned seed = 10; seed < 30; ++seed) expect_as_naive(seed, 12, 20, 60);
  expect_as_naive(50, 12, 100, 1200);  // more than a hundred of a class and image
}

/// The reference implementation's numbers; the files are not part of the repository.
class SegmentationGold : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder_)) GTEST_SKIP() << folder_ << " does not exist";
  }

  SegmentationErrors errors(const SegmentationErrorOptions& options = {}) const {
    return segmentation_error(
        read_coco(folder_ / "instances_val2014_100.json"),
        read_coco_results(folder_ / "instances_val2014_fakesegm100_results.json"), options);
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::path(MMS_SOURCE_DIR) / ".." / "shared" / "data" / "coco_eval";
};

TEST_F(SegmentationGold, AllClasses) {
  expect_scores(errors().all,
                {0.3195452758576433, 0.5622883972521636, 0.29892653412086784, 0.3873740315997838,
                 0.31018272403369485, 0.3269339071005138, 0.2682297225711534, 0.41544868114906375,
                 0.4168394992198818, 0.4694498622754236, 0.37675922666197265, 0.3814715099715099});
}

TEST_F(SegmentationGold, Person) {
  const std::vector<double> gold = {0.2698816207265341, 0.6131378135415071, 0.17882861007060288};
  expect_scores(errors({.category = "person"}).all, gold);
  expect_scores(errors().per_class.front().scores, gold);
}

}  // namespace
}  // namespace mms
