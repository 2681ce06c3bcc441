#include "mms/server/scene/pictures.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "mms/io/image/image_io.hpp"
#include "mms/server/scene/picture_cache.hpp"
#include "tests/server/scenes.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

TEST(Pictures, ShrinksBySquareMeans) {
  Image<Rgb> image(6, 4);
  for (std::size_t i = 0; i < image.size(); ++i)
    image[i] = {static_cast<std::uint8_t>(10 * i), 7, 0};
  const Image<Rgb> small = shrunk(image, 3);
  ASSERT_EQ(small.width(), 3);
  ASSERT_EQ(small.height(), 2);
  EXPECT_EQ(small(0, 0), (Rgb{35, 7, 0}));  // of 0, 10, 60, 70
  EXPECT_EQ(shrunk(image, 6).width(), 6);
  EXPECT_EQ(shrunk(image, 5).width(), 3);
}

TEST(Pictures, MaskIsOnePlusClass) {
  const Image<std::uint8_t> mask = mask_of(view_of(0)->cloud);
  ASSERT_EQ(mask.width(), 4);
  EXPECT_EQ(mask(3, 1), 2);  // a vehicle
  EXPECT_EQ(mask(0, 0), 0);
  EXPECT_EQ(mask(2, 1), 0);
  LabeledCloud with_mask = view_of(0)->cloud;
  with_mask.dynamic_pixels = Image<std::uint8_t>(4, 2);
  for (const std::size_t i : {5U, 6U, 0U}) with_mask.dynamic_pixels[i] = 255;
  const Image<std::uint8_t> closed = mask_of(with_mask);
  EXPECT_EQ(closed(1, 1), 2) << "under the vehicle's mask, without depth";
  EXPECT_EQ(closed(0, 0), 1) << "a mask of its own";
  EXPECT_EQ(closed(3, 0), 0);
  with_mask.overruled = Image<std::uint8_t>(4, 2);
  with_mask.overruled[7] = 1;
  EXPECT_EQ(mask_of(with_mask)(3, 1), kOverruledMask);
  EXPECT_EQ(mask_of(with_mask)(1, 1), 2);
  LabeledCloud lidar = view_of(0)->cloud;
  lidar.width = 8;
  lidar.height = 1;
  EXPECT_TRUE(mask_of(lidar).empty());
}

TEST(Pictures, SelectsEvenlySpacedPointsWithReturn) {
  LabeledCloud cloud;
  for (int i = 0; i < 1000; ++i) {
    cloud.points.emplace_back(static_cast<float>(i), 0.0F, 0.0F);
    cloud.labels.push_back(i % 2 == 0 ? PointLabel::kStatic : PointLabel::kInvalid);
  }
  cloud.labels[400] = PointLabel::kDynamic;
  std::vector<std::uint8_t> dynamic;
  EXPECT_EQ(scan_points(cloud, 5000, dynamic).points.size(), 500U);
  EXPECT_EQ(std::count(dynamic.begin(), dynamic.end(), 1), 1);
  const ColoredPoints few = scan_points(cloud, 100, dynamic);
  ASSERT_EQ(few.points.size(), 100U);
  for (std::size_t i = 1; i < few.points.size(); ++i) {
    EXPECT_EQ(few.points[i].x() - few.points[i - 1].x(), 10.0F);
  }
  EXPECT_TRUE(scan_points({}, 100, dynamic).points.empty());
}

TEST(Pictures, AreEncodedAsFiles) {
  const EncodedPictures pictures = encode_pictures(*view_of(3));
  EXPECT_EQ(pictures.frame, 3U);
  EXPECT_EQ(decode_color(pictures.jpeg, "jpeg").width(), 8);
  EXPECT_EQ(decode_color(pictures.mask_png, "mask").height(), 2);
  SensorView bare;
  EXPECT_TRUE(encode_pictures(bare).jpeg.empty());
}

TEST(PictureCache, EncodesFrameOnce) {
  Scene scene(scene_info(false));
  int loads = 0;
  scene.set_loader([&](std::size_t frame) -> std::shared_ptr<const SensorView> {
    ++loads;
    return frame < 5 ? view_of(frame) : nullptr;
  });
  PictureCache cache(scene);
  const auto first = cache.get(2);
  EXPECT_EQ(first->frame, 2U);
  EXPECT_EQ(cache.get(2), first);
  EXPECT_EQ(loads, 1);
  EXPECT_EQ(cache.get(9), nullptr);
}

TEST(PictureCache, ReturnsNewestOfLiveRun) {
  Scene scene(scene_info(true));
  PictureCache cache(scene);
  EXPECT_EQ(cache.get(std::nullopt), nullptr);
  scene.add(frame_at(0), view_of(0), nullptr);
  const auto newest = cache.get(std::nullopt);
  ASSERT_NE(newest, nullptr);
  scene.add(frame_at(1), view_of(1), nullptr);
  EXPECT_EQ(cache.get(0), newest) << "it was encoded before";
  EXPECT_EQ(cache.get(1)->frame, 1U);
}

}  // namespace
}  // namespace mms
