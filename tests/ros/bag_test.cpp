#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/io/text/files.hpp"
#include "mms/ros/bag_reader.hpp"
#include "mms/ros/bag_scan.hpp"
#include "mms/ros/bag_writer.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using namespace testing;  // NOLINT: helpers of the tests

msg::Image image_at(Timestamp stamp) {
  msg::Image image;
  image.header.stamp = stamp;
  image.data.assign(1000, static_cast<std::uint8_t>(stamp.nanoseconds()));
  return image;
}

class Bag : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!MMS_WITH_ROSBAG) GTEST_SKIP() << "librosbag-storage-dev is not installed";
    BagWriter bag(path_);
    for (int i = 0; i < 5; ++i) bag.write("/image", Timestamp(100 + i), image_at(Timestamp(i)));
    bag.write("/pose", Timestamp(50), msg::PoseStamped());
    bag.finish();
  }

  std::string bytes() const { return read_file(path_); }
  std::string error(const std::string& bytes) const {
    return message_of<DataError>([&] { BagReader reader(folder_.write("b.bag", bytes)); });
  }

  TempFolder folder_;
  fs::path path_ = folder_.path() / "a.bag";
};

TEST_F(Bag, RoundTrips) {
  const BagReader bag(path_);
  EXPECT_EQ(listed(bag.topics()),
            "/image sensor_msgs/Image (5), /pose geometry_msgs/PoseStamped (1)");
  EXPECT_EQ(bag.count("/image"), 5U);
  EXPECT_EQ(bag.count("/other"), 0U);
  EXPECT_EQ(bag.received("/image", 3), Timestamp(103));
  for (const std::size_t i : {4U, 0U, 2U}) {
    const auto image = bag.read<msg::Image>("/image", i);
    EXPECT_EQ(image.header.stamp, Timestamp(static_cast<std::int64_t>(i)));
    EXPECT_EQ(image.data, std::vector<std::uint8_t>(1000, static_cast<std::uint8_t>(i)));
  }
}

TEST_F(Bag, RejectsMessageOfOtherType) {
  const BagReader bag(path_);
  expect_in("a.bag: /pose message 0: ",
            message_of<DataError>([&] { bag.read<msg::CameraInfo>("/pose", 0); }));
}

TEST_F(Bag, LeavesNoFileWithoutFinish) {
  const fs::path path = folder_.path() / "c.bag";
  {
    BagWriter bag(path);
    bag.write("/image", Timestamp(1), image_at(Timestamp(1)));
  }
  EXPECT_FALSE(fs::exists(path));
  EXPECT_FALSE(fs::exists(path.string() + ".part"));
  expect_in("its folder does not exist",
            message_of<FileError>([&] { BagWriter bag(folder_.path() / "no" / "c.bag"); }));
}

TEST_F(Bag, TruncatedBagErrorListsTopics) {
  const std::string whole = bytes();
  for (const std::size_t size : {whole.size() - 1, whole.size() - 700, std::size_t{8000}}) {
    const std::string message = error(whole.substr(0, size));
    expect_in("b.bag: is truncated: it has /image sensor_msgs/Image (", message);
    expect_in("rosbag reindex b.bag", message);
  }
}

TEST_F(Bag, EveryTruncationIsOneError) {
  const std::string whole = bytes();
  for (std::size_t size = 13; size < whole.size(); size += 97) {
    EXPECT_THROW(BagReader reader(folder_.write("b.bag", whole.substr(0, size))), DataError)
        << size;
  }
}

TEST_F(Bag, UnindexedBagErrorListsTopics) {
  std::string unclosed = bytes();
  constexpr std::string_view kField = "index_pos=";
  const std::size_t at = unclosed.find(kField) + kField.size();
  std::uint64_t index = 0;
  std::memcpy(&index, unclosed.data() + at, sizeof index);
  unclosed.resize(index);
  unclosed.replace(at, sizeof index, sizeof index, '\0');
  const std::string message = error(unclosed);
  expect_in(
      "b.bag: has no index because it was not closed: it has /image sensor_msgs/Image (5), "
      "/pose geometry_msgs/PoseStamped (1)",
      message);
  expect_in("rosbag reindex b.bag", message);
}

TEST_F(Bag, RejectsOtherFiles) {
  expect_in("b.bag: is empty, 0 bytes", error(""));
  expect_in("b.bag: is not a ROS 1 bag of version 2.0", error("#ROSBAG V1.2\n"));
  expect_in("b.bag: is not a ROS 1 bag of version 2.0", error("SQLite format 3"));
  expect_in("no such file",
            message_of<FileError>([&] { BagReader bag(folder_.path() / "none.bag"); }));
}

TEST(BagNames, AreRecognizedByExtension) {
  EXPECT_TRUE(is_bag_name("x/a.bag"));
  EXPECT_TRUE(is_bag_name("a.bag.active"));
  EXPECT_FALSE(is_bag_name("bag"));
}

TEST(BagWithoutRosbag, ErrorNamesPackageToInstall) {
  if (MMS_WITH_ROSBAG) GTEST_SKIP() << "bags can be read";
  const TempFolder folder;
  expect_in("install librosbag-storage-dev",
            message_of<FileError>([&] { BagReader bag(folder.write("a.bag", "")); }));
}

}  // namespace
}  // namespace mms
