#include "mms/evaluation/segmentation/segmentation_error.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "mms/core/error.hpp"
#include "tests/evaluation/coco_cases.hpp"

namespace mms {
namespace {

using test::add_person;
using test::box;
using test::empty_truth;
using test::expect_scores;
using test::kTolerance;
using Results = std::vector<CocoResult>;

SegmentationScores scores(const CocoDataset& truth, const Results& results) {
  return segmentation_error(truth, results).all;
}

const double kNone = std::nan("");

TEST(SegmentationError, IsOneForGroundTruth) {
  CocoDataset truth = empty_truth(3);
  const std::vector<Rle> masks = {box(3, 4, 10, 10), box(10, 0, 50, 60), box(0, 0, 100, 99)};
  Results results;
  for (std::size_t i = 0; i < masks.size(); ++i) {
    const auto image = static_cast<std::int64_t>(i) + 1;
    add_person(truth, image, masks[i]);
    results.push_back({image, 1, 0.5, masks[i]});
  }
  expect_scores(scores(truth, results), std::vector<double>(12, 1.0));
}

TEST(SegmentationError, HalfRecallForOneMiss) {
  CocoDataset truth = empty_truth(1);
  add_person(truth, 1, box(0, 0, 10, 10));
  add_person(truth, 1, box(50, 0, 40, 50));
  const double half = 51.0 / 101.0;  // the recalls 0 to 0.50
  expect_scores(scores(truth, {{1, 1, 0.9, box(0, 0, 10, 10)}}),
                {half, half, half, 1.0, 0.0, kNone, 0.5, 0.5, 0.5, 1.0, 0.0, kNone});
}

TEST(SegmentationError, FalseAlarmCountsOnlyWithHigherScore) {
  CocoDataset truth = empty_truth(1);
  add_person(truth, 1, box(0, 0, 10, 10));
  const auto with_alarm = [&](double score) {
    return scores(truth, {{1, 1, 0.5, box(0, 0, 10, 10)}, {1, 1, score, box(60, 60, 10, 10)}});
  };
  EXPECT_NEAR(with_alarm(0.4).ap, 1.0, kTolerance);
  EXPECT_NEAR(with_alarm(0.6).ap, 0.5, kTolerance);
  EXPECT_NEAR(with_alarm(0.6).ar1, 0.0, kTolerance);
  EXPECT_NEAR(with_alarm(0.6).ar10, 1.0, kTolerance);
}

TEST(SegmentationError, DuplicateDetectionIsFalseAlarm) {
  CocoDataset truth = empty_truth(1);
  add_person(truth, 1, box(0, 0, 10, 10));
  add_person(truth, 1, box(50, 0, 10, 10));
  const Results results = {{1, 1, 0.9, box(0, 0, 10, 10)},
                           {1, 1, 0.8, box(0, 0, 10, 10)},
                           {1, 1, 0.7, box(50, 0, 10, 10)}};
  EXPECT_NEAR(scores(truth, results).ap, (51.0 + 50.0 * 2.0 / 3.0) / 101.0, kTolerance);
}

TEST(SegmentationError, OverlapAtThresholdIsHit) {
  CocoDataset truth = empty_truth(1);
  add_person(truth, 1, box(0, 0, 100, 1));
  for (int i = 0; i < 10; ++i) {  // 50 of 100 px, 55 of 100 px, ...
    const auto exact = scores(truth, {{1, 1, 0.9, box(0, 0, 50 + 5 * i, 1)}});
    EXPECT_NEAR(exact.ap, 0.1 * (i + 1), kTolerance);
    EXPECT_NEAR(exact.ap75, i < 5 ? 0.0 : 1.0, kTolerance);
    const auto below = scores(truth, {{1, 1, 0.9, box(0, 0, 49 + 5 * i, 1)}});
    EXPECT_NEAR(below.ap, 0.1 * i, kTolerance);
  }
}

TEST(SegmentationError, IgnoresDetectionsInCrowd) {
  CocoDataset truth = empty_truth(1);
  add_person(truth, 1, box(0, 0, 60, 100)).iscrowd = true;
  const Results in_crowd = {{1, 1, 0.9, box(0, 0, 10, 10)}, {1, 1, 0.8, box(20, 0, 10, 10)}};
  expect_scores(scores(truth, in_crowd), std::vector<double>(12, kNone));
  add_person(truth, 1, box(70, 0, 10, 10));
  Results results = in_crowd;
  results.push_back({1, 1, 0.7, box(70, 0, 10, 10)});
  EXPECT_NEAR(scores(truth, results).ap, 1.0, kTolerance);
  results.push_back({1, 1, 0.95, box(54, 40, 10, 10)});  // 60 % of it inside
  EXPECT_NEAR(scores(truth, results).ap, (3 * 1.0 + 7 * 0.5) / 10.0, kTolerance);
}

TEST(SegmentationError, SizeAtBorderIsInBothRanges) {
  CocoDataset truth = empty_truth(1);
  add_person(truth, 1, box(0, 0, 32, 32));
  const auto found = scores(truth, {{1, 1, 0.9, box(0, 0, 32, 32)}});
  expect_scores(found, {1.0, 1.0, 1.0, 1.0, 1.0, kNone, 1.0, 1.0, 1.0, 1.0, 1.0, kNone});
}

TEST(SegmentationError, UsesAnnotatedArea) {
  CocoDataset truth = empty_truth(1);
  add_person(truth, 1, box(0, 0, 30, 30)).area = 5000.0;
  const auto found = scores(truth, {{1, 1, 0.9, box(0, 0, 30, 30)}});
  EXPECT_TRUE(std::isnan(found.ap_small));
  EXPECT_NEAR(found.ap_medium, 1.0, kTolerance);
}

TEST(SegmentationError, IgnoresFalseAlarmsOfOtherSize) {
  CocoDataset truth = empty_truth(1);
  add_person(truth, 1, box(0, 0, 10, 10));
  const auto found =
      scores(truth, {{1, 1, 0.5, box(0, 0, 10, 10)}, {1, 1, 0.9, box(40, 40, 50, 50)}});
  EXPECT_NEAR(found.ap, 0.5, kTolerance);
  EXPECT_NEAR(found.ap_small, 1.0, kTolerance);
}

TEST(SegmentationError, EqualScoresAreOrderedByImageThenList) {
  CocoDataset truth = empty_truth(2);
  add_person(truth, 2, box(0, 0, 10, 10));
  const CocoResult hit = {2, 1, 0.5, box(0, 0, 10, 10)};
  const CocoResult alarm_before = {1, 1, 0.5, box(0, 0, 10, 10)};
  const CocoResult alarm_beside = {2, 1, 0.5, box(50, 0, 10, 10)};
  EXPECT_NEAR(scores(truth, {hit, alarm_before}).ap, 0.5, kTolerance);
  EXPECT_NEAR(scores(truth, {hit, alarm_beside}).ap, 1.0, kTolerance);
  EXPECT_NEAR(scores(truth, {alarm_beside, hit}).ap, 0.5, kTolerance);
}

TEST(SegmentationError, UsesHundredBestPerImage) {
  CocoDataset truth = empty_truth(1);
  add_person(truth, 1, box(0, 0, 10, 10));
  Results results(99, CocoResult{1, 1, 0.9, box(50, 50, 10, 10)});
  results.push_back({1, 1, 0.5, box(0, 0, 10, 10)});
  EXPECT_NEAR(scores(truth, results).ap, 0.01, kTolerance);
  results.push_back({1, 1, 0.9, box(50, 50, 10, 10)});
  EXPECT_NEAR(scores(truth, results).ap, 0.0, kTolerance);
}

TEST(SegmentationError, IsMeanOverClassesWithObjects) {
  CocoDataset truth = empty_truth(1);
  truth.categories = {{3, "ghost"}, {2, "agv"}, {1, "person"}};
  add_person(truth, 1, box(0, 0, 10, 10));
  add_person(truth, 1, box(50, 0, 10, 10)).category_id = 2;
  const Results results = {{1, 1, 0.9, box(0, 0, 10, 10)},
                           {1, 2, 0.9, box(0, 0, 10, 10)},
                           {1, 3, 0.9, box(0, 0, 10, 10)},    // no object is a ghost
                           {1, 99, 0.9, box(0, 0, 10, 10)}};  // a class without a category
  const SegmentationErrors errors = segmentation_error(truth, results);
  EXPECT_EQ(errors.results, 3U);
  EXPECT_EQ(errors.objects, 2U);
  ASSERT_EQ(errors.per_class.size(), 3U);
  EXPECT_EQ(errors.per_class[0].name, "person");
  EXPECT_EQ(errors.per_class[2].name, "ghost");
  EXPECT_NEAR(errors.per_class[0].scores.ap, 1.0, kTolerance);
  EXPECT_NEAR(errors.per_class[1].scores.ap, 0.0, kTolerance);
  EXPECT_TRUE(std::isnan(errors.per_class[2].scores.ap));
  EXPECT_NEAR(errors.all.ap, 0.5, kTolerance);
}

TEST(SegmentationError, SelectsClassAndSplit) {
  CocoDataset truth = empty_truth(2);
  truth.images[0].split = "train";
  truth.images[1].split = "holdout";
  truth.categories.push_back({2, "agv"});
  for (const int image : {1, 2}) add_person(truth, image, box(0, 0, 10, 10));
  add_person(truth, 2, box(50, 50, 10, 10)).category_id = 2;
  const Results results = {{2, 1, 0.9, box(0, 0, 10, 10)}, {1, 1, 0.95, box(50, 0, 10, 10)}};
  const auto errors =
      segmentation_error(truth, results, {.category = "person", .split = "holdout"});
  EXPECT_EQ(errors.images, 1U);
  EXPECT_EQ(errors.objects, 1U);
  EXPECT_EQ(errors.results, 1U);
  ASSERT_EQ(errors.per_class.size(), 1U);
  EXPECT_NEAR(errors.all.ap, 1.0, kTolerance);
  EXPECT_NEAR(segmentation_error(truth, results, {.split = "holdout"}).all.ap, 0.5, kTolerance);
  EXPECT_NEAR(segmentation_error(truth, results, {.split = "train"}).all.ap, 0.0, kTolerance);
}

TEST(SegmentationError, IsNanWithoutObjects) {
  EXPECT_TRUE(std::isnan(scores({}, {}).ap));
  EXPECT_TRUE(std::isnan(scores(empty_truth(1), {{1, 1, 0.5, box(0, 0, 1, 1)}}).ar100));
}

std::string error_of(const CocoDataset& truth, const Results& results,
                     const SegmentationErrorOptions& options = {}) {
  try {
    segmentation_error(truth, results, options);
  } catch (const DataError& error) {
    return error.what();
  }
  return "";
}

TEST(SegmentationError, ErrorsNameProblemAndExpectation) {
  CocoDataset truth = empty_truth(1);
  truth.categories.push_back({2, "agv"});
  const CocoResult valid = {1, 1, 0.5, box(0, 0, 1, 1)};
  EXPECT_EQ(error_of(truth, {valid, {7, 1, 0.5, box(0, 0, 1, 1)}},
                     {.truth_name = "a.json", .results_name = "b.json"}),
            "b.json: [1].image_id: is 7, no such image (the images are those of a.json)");
  EXPECT_EQ(error_of(truth, {{1, 1, 0.5, box(0, 0, 1, 1, 50)}}),
            "results: [0].segmentation: has 50 x 50 px, its image 1 has 100 x 100 px (masks must "
            "have the size of the image in truth)");
  EXPECT_EQ(error_of(truth, {{1, 1, kNone, box(0, 0, 1, 1)}}),
            "results: [0].score: is not a number (expected 0 to 1)");
  EXPECT_EQ(error_of(truth, {valid}, {.category = "cat"}),
            "truth: has no class 'cat' (its classes: agv, person)");
  EXPECT_EQ(error_of(truth, {valid}, {.split = "holdout"}),
            "truth: has no images in the split 'holdout' (its splits: none)");
  truth.images[0].split = "train";
  EXPECT_EQ(error_of(truth, {valid}, {.split = "holdout"}),
            "truth: has no images in the split 'holdout' (its splits: train)");
}

TEST(SegmentationError, JsonHasDocumentedKeysInOrder) {
  SegmentationErrors errors;
  errors.all.ap50 = 1.0 / 3.0;
  errors.per_class = {{"person", {.ap = kNone}}};
  EXPECT_EQ(to_json(errors),
            R"({"AP":0.0,"AP50":0.3333333333333333,"AP75":0.0,"APs":0.0,"APm":0.0,"APl":0.0,)"
            R"("AR1":0.0,"AR10":0.0,"AR100":0.0,"ARs":0.0,"ARm":0.0,"ARl":0.0,"per_class":{)"
            R"("person":{"AP":null,"AP50":0.0,"AP75":0.0,"APs":0.0,"APm":0.0,"APl":0.0,)"
            R"("AR1":0.0,"AR10":0.0,"AR100":0.0,"ARs":0.0,"ARm":0.0,"ARl":0.0}}})");
}

TEST(SegmentationError, TableHasLinePerClassAndTotal) {
  SegmentationErrors errors;
  errors.per_class = {{"person", {.ap = kNone, .ap50 = 0.25}}};
  const std::string zeros =
      "  0.000  0.000  0.000  0.000  0.000  0.000  0.000  0.000  0.000  0.000";
  EXPECT_EQ(to_table(errors),
            "class      AP   AP50   AP75    APs    APm    APl    AR1   AR10  AR100    ARs    ARm"
            "    ARl\n"
            "person    n/a  0.250" +
                zeros +
                "\n"
                "all     0.000  0.000" +
                zeros + "\n");
}

TEST(SegmentationError, IsFast) {
  // 30,000 results on 5,000 images, each with a dozen runs or more.
  CocoDataset truth = empty_truth(5000);
  Results results;
  for (int image = 1; image <= 5000; ++image) {
    for (int i = 0; i < 6; ++i) {
      const Rle mask = box(10 * i, image % 50, 30, 40);
      add_person(truth, image, mask);
      results.push_back({image, 1, 0.01 * ((image + i) % 100), mask});
    }
  }
  const auto start = std::chrono::steady_clock::now();
  EXPECT_NEAR(scores(truth, results).ap, 1.0, kTolerance);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));  // here 0.2 s
}

}  // namespace
}  // namespace mms
