#include "mms/segmentation/segmenters/network_segmenter.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"

namespace mms {
namespace {

/// Detects the same objects in every image.
class FixedDetector : public Detector {
 public:
  FixedDetector(std::vector<Detection> found, std::vector<std::string> classes)
      : found_(std::move(found)), classes_(std::move(classes)) {}
  std::vector<Detection> detect(const Image<Rgb>&) override { return found_; }
  const std::vector<std::string>& classes() const override { return classes_; }

 private:
  std::vector<Detection> found_;
  std::vector<std::string> classes_;
};

Detection object(int category, float score) {
  return {category, score, 3, 4, Image<std::uint8_t>(2, 2, 1)};
}

Segmentation segment(const NetworkSegmenterConfig& config) {
  NetworkSegmenter segmenter(
      std::make_unique<FixedDetector>(std::vector<Detection>{object(2, 0.9F), object(0, 0.8F),
                                                             object(1, 0.7F), object(2, 0.2F)},
                                      std::vector<std::string>{"chair", "truck", "person"}),
      config);
  Frame frame;
  frame.color = Image<Rgb>(20, 10);
  return segmenter.segment(frame);
}

TEST(NetworkSegmenter, TakesPeopleAndVehiclesAboveScore) {
  const Segmentation found = segment({});
  EXPECT_EQ(found.width, 20);
  EXPECT_EQ(found.height, 10);
  ASSERT_EQ(found.instances.size(), 2U);
  EXPECT_EQ(found.instances[0].object_class, ObjectClass::kPerson);
  EXPECT_EQ(found.instances[0].x, 3);
  EXPECT_EQ(found.instances[0].y, 4);
  EXPECT_EQ(found.instances[1].object_class, ObjectClass::kAgv);
}

TEST(NetworkSegmenter, OmitsDisabledClasses) {
  EXPECT_EQ(segment({.score = 0.1, .agv = false}).instances.size(), 2U);
  EXPECT_EQ(segment({.person = false}).instances.size(), 1U);
  EXPECT_THROW(segment({.person = false, .agv = false}), DataError);
}

TEST(NetworkSegmenter, KnowsTheNamesOfOtherModels) {
  for (const char* name : {"person", "Person", "PEDESTRIAN", "human", "Worker", "people"}) {
    EXPECT_TRUE(object_class_of(name) == ObjectClass::kPerson) << name;
  }
  for (const char* name : {"agv", "AGV", "AMR", "Forklift", "van", "Truck"}) {
    EXPECT_TRUE(object_class_of(name) == ObjectClass::kAgv) << name;
  }
  for (const char* name : {"", "pallet", "personal computer", "train", "Chair"}) {
    EXPECT_FALSE(object_class_of(name).has_value()) << name;
  }
}

TEST(NetworkSegmenter, NoInstancesWithoutImage) {
  NetworkSegmenter segmenter(
      std::make_unique<FixedDetector>(std::vector<Detection>{object(0, 1.0F)},
                                      std::vector<std::string>{"person"}),
      {});
  EXPECT_TRUE(segmenter.segment({}).instances.empty());
}

}  // namespace
}  // namespace mms
