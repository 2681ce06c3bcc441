// Search of similar descriptors, and recognition of places by them.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "mms/core/random_stream.hpp"
#include "mms/global_map/places/descriptor_forest.hpp"
#include "mms/global_map/places/place_recognizer.hpp"

namespace mms {
namespace {

BinaryDescriptor random_descriptor(RandomStream& random) {
  BinaryDescriptor descriptor;
  for (std::uint64_t& word : descriptor.words) word = random.bits();
  return descriptor;
}

/// With every bit flipped with a probability.
BinaryDescriptor noisy(BinaryDescriptor descriptor, float probability, RandomStream& random) {
  for (std::size_t i = 0; i < BinaryDescriptor::kBits; ++i) {
    if (random.chance(probability)) descriptor.words[i / 64] ^= std::uint64_t{1} << (i % 64);
  }
  return descriptor;
}

std::vector<BinaryDescriptor> noisy(std::vector<BinaryDescriptor> place, RandomStream& random) {
  for (BinaryDescriptor& descriptor : place) descriptor = noisy(descriptor, 0.1F, random);
  return place;
}

std::vector<BinaryDescriptor> random_place(RandomStream& random) {
  std::vector<BinaryDescriptor> place;
  for (int i = 0; i < 100; ++i) place.push_back(random_descriptor(random));
  return place;
}

TEST(BinaryDescriptor, HammingDistanceCountsDifferentBits) {
  BinaryDescriptor a;
  BinaryDescriptor b;
  b.words = {1, 2, 3, 0xFFFFFFFFFFFFFFFFU};
  EXPECT_EQ(hamming_distance(a, b), 1 + 1 + 2 + 64);
  EXPECT_TRUE(b.bit(0));
  EXPECT_TRUE(b.bit(65));
  EXPECT_FALSE(b.bit(64));
}

TEST(DescriptorForest, FindsMostDescriptorsWithATenthOfTheirBitsFlipped) {
  RandomStream random(3);
  DescriptorForest forest;
  for (int i = 0; i < 20000; ++i) forest.insert(random_descriptor(random));
  int found = 0;
  constexpr int kQueries = 500;
  std::size_t compared = 0;
  for (int q = 0; q < kQueries; ++q) {
    const auto id = static_cast<std::uint32_t>(random.below(forest.size()));
    std::vector<std::uint32_t> ids;
    forest.find(noisy(forest.at(id), 0.1F, random), ids);
    found += std::binary_search(ids.begin(), ids.end(), id);
    compared += ids.size();
  }
  EXPECT_GT(found, kQueries / 2);
  EXPECT_LT(compared / kQueries, 256U);  // four leaves
}

TEST(DescriptorForest, ManyCopiesOfADescriptorDoNotFillTheSearch) {
  DescriptorForest forest;
  for (int i = 0; i < 10000; ++i) forest.insert({});
  std::vector<std::uint32_t> ids;
  forest.find({}, ids);
  EXPECT_GT(ids.size(), 0U);
  EXPECT_LE(ids.size(), 64U);
}

TEST(PlaceRecognizer, FindsThePlaceAmongOthers) {
  RandomStream random(5);
  PlaceRecognizer recognizer;
  std::vector<std::vector<BinaryDescriptor>> places;
  for (int i = 0; i < 200; ++i) {
    places.push_back(random_place(random));
    recognizer.add(places.back());
  }
  for (const std::size_t place : {0U, 77U, 199U}) {
    const auto candidates = recognizer.find(noisy(places[place], random), 200, 3);
    ASSERT_FALSE(candidates.empty());
    EXPECT_EQ(candidates.front().keyframe, place);
  }
  EXPECT_TRUE(recognizer.find(random_place(random), 200, 3).empty());
}

TEST(PlaceRecognizer, FindsNoKeyframeFromTheEndOn) {
  RandomStream random(7);
  PlaceRecognizer recognizer;
  const std::vector<BinaryDescriptor> place = random_place(random);
  for (int i = 0; i < 10; ++i) recognizer.add(random_place(random));
  recognizer.add(place);
  EXPECT_TRUE(recognizer.find(place, 10, 3).empty());
  EXPECT_EQ(recognizer.find(place, 11, 3).size(), 1U);
}

TEST(PlaceRecognizer, SuccessiveKeyframesAreOneCandidate) {
  RandomStream random(9);
  PlaceRecognizer recognizer;
  const std::vector<BinaryDescriptor> place = random_place(random);
  for (int i = 0; i < 4; ++i) recognizer.add(noisy(place, random));
  for (int i = 0; i < 20; ++i) recognizer.add(random_place(random));
  for (int i = 0; i < 4; ++i) recognizer.add(noisy(place, random));
  const auto candidates = recognizer.find(place, recognizer.size(), 5);
  ASSERT_EQ(candidates.size(), 2U);
  EXPECT_NE(candidates[0].keyframe < 4, candidates[1].keyframe < 4);
}

TEST(PlaceRecognizer, DescriptorsOfEveryPlaceCountLittle) {
  RandomStream random(11);
  PlaceRecognizer recognizer;
  const std::vector<BinaryDescriptor> everywhere = random_place(random);
  for (int i = 0; i < 60; ++i) {
    std::vector<BinaryDescriptor> place = random_place(random);
    place.insert(place.end(), everywhere.begin(), everywhere.begin() + 10);
    recognizer.add(place);
  }
  EXPECT_TRUE(recognizer.find({everywhere.begin(), everywhere.begin() + 10}, 60, 3).empty());
}

TEST(PlaceRecognizer, KeyframesThatCannotBeUsedTakeNoRoom) {
  RandomStream random(13);
  PlaceRecognizer recognizer;
  const auto place = random_place(random);
  for (int i = 0; i < 40; ++i) recognizer.add(i % 10 == 0 ? place : random_place(random));
  const auto found =
      recognizer.find(noisy(place, random), 40, 3, [](std::size_t i) { return i == 30; });
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].keyframe, 30U);
}

}  // namespace
}  // namespace mms
