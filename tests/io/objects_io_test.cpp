#include "mms/io/results/objects_io.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::expect_in;
using testing::message_of;
using testing::TempFolder;

ObjectBox object(int id, ObjectClass object_class, double x) {
  ObjectBox box;
  box.id = id;
  box.object_class = object_class;
  box.T_world_box = Eigen::Translation3d(x, -0.5, 4.0) *
                    Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()) *
                    Eigen::Isometry3d::Identity();
  box.size = {0.6, 0.5, 1.75};
  box.velocity = {1.25, 0.0, -0.5};
  box.moving = id == 3;
  return box;
}

/// An entry of objects_truth.json with additional keys.
std::string truth_with(const std::string& more) {
  return R"({"frames": [{"stamp": "1.500000000", "objects": [{"id": 2, "class": "agv",)"
         R"("position": [1, 2, 3], "quaternion": [0, 0, 0, 1], "size": [1, 1, 2],)"
         R"("velocity": [0, 0, 0.5], "moving": true)" +
         more + "}]}]}";
}

TEST(ObjectsIo, HistoryRoundTrips) {
  const TempFolder folder;
  const ObjectHistory history = {
      {Timestamp(1'500'000'000), {object(3, ObjectClass::kPerson, 1.0)}},
      {Timestamp(1'533'333'333),
       {object(3, ObjectClass::kPerson, 1.1), object(8, ObjectClass::kAgv, 2.0)}}};
  const ObjectHistory read = read_objects(folder.write("objects.json", objects_json(history)));
  ASSERT_EQ(read.size(), history.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].stamp, history[i].stamp);
    ASSERT_EQ(read[i].objects.size(), history[i].objects.size());
    for (std::size_t j = 0; j < read[i].objects.size(); ++j) {
      const ObjectBox& a = read[i].objects[j];
      const ObjectBox& b = history[i].objects[j];
      EXPECT_EQ(a.id, b.id);
      EXPECT_EQ(a.object_class, b.object_class);
      EXPECT_TRUE(a.T_world_box.isApprox(b.T_world_box, 1e-12));
      EXPECT_EQ(a.size, b.size);
      EXPECT_EQ(a.velocity, b.velocity);
      EXPECT_EQ(a.moving, b.moving);
    }
  }
}

TEST(ObjectsIo, EmptyHistoryRoundTrips) {
  const TempFolder folder;
  EXPECT_TRUE(read_objects(folder.write("objects.json", objects_json({}))).empty());
}

TEST(ObjectsIo, VisibleShareCombinesOcclusionAndTruncation) {
  const TempFolder folder;
  const auto file = folder.write(
      "truth.json", truth_with(R"(, "pixels": 10, "occlusion": 0.5, "truncation": 0.2)"));
  const ObjectHistory truth = read_objects_truth(file);
  ASSERT_EQ(truth.at(0).objects.size(), 1U);
  EXPECT_NEAR(truth[0].objects[0].visible, 0.4, 1e-12);
  EXPECT_EQ(truth[0].objects[0].object_class, ObjectClass::kAgv);
  EXPECT_TRUE(truth[0].objects[0].moving);
  const auto hidden =
      folder.write("b.json", truth_with(R"(, "pixels": 0, "occlusion": 0, "truncation": 0)"));
  EXPECT_EQ(read_objects_truth(hidden)[0].objects[0].visible, 0.0);
}

TEST(ObjectsIo, ErrorsNameEntry) {
  const TempFolder folder;
  const auto error = [&](const std::string& text) {
    const auto file = folder.write("truth.json", text);
    return message_of<DataError>([&] { read_objects_truth(file); });
  };
  expect_in("frames[0].objects[0]: missing key 'pixels'", error(truth_with("")));
  expect_in("occlusion: is 2, allowed:", error(truth_with(R"(, "pixels": 1, "occlusion": 2)")));
  expect_in("moving: is a number, expected true or false", error(truth_with(R"(, "moving": 1)")));
  expect_in("class: is 'dog', allowed: person, agv, unknown",
            error(truth_with(R"(, "class": "dog")")));
  expect_in("quaternion: is not a rotation", error(truth_with(R"(, "quaternion": [0, 0, 0, 0])")));
  expect_in("position: is not a list of 3 numbers", error(truth_with(R"(, "position": [1])")));
  expect_in("stamp: is 'now'", error(R"({"frames": [{"stamp": "now", "objects": []}]})"));
}

}  // namespace
}  // namespace mms
