#include "mms/ros/wire.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/ros/message_types.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms::msg {
namespace {

using namespace mms::testing;  // NOLINT: helpers of the tests

template <class Message>
std::string bytes_of(const Message& message) {
  std::string bytes(encoded_size(message), '\0');
  encode(message, reinterpret_cast<std::uint8_t*>(bytes.data()));
  return bytes;
}

TEST(Wire, ImagesUseRosLayout) {
  Image image;
  image.header = {7, Timestamp(3'000'000'005), "ab"};
  image.height = 1;
  image.width = 2;
  image.encoding = "mono8";
  image.step = 2;
  image.data = {9, 8};
  const std::string expected(
      "\x07\0\0\0"  // seq
      "\x03\0\0\0\x05\0\0\0"
      "\x02\0\0\0ab"
      "\x01\0\0\0\x02\0\0\0"
      "\x05\0\0\0mono8\0"
      "\x02\0\0\0"
      "\x02\0\0\0\x09\x08",
      46);
  EXPECT_EQ(bytes_of(image), expected);
  const auto back = decode<Image>(expected, "test");
  EXPECT_EQ(back.header.stamp, Timestamp(3'000'000'005));
  EXPECT_EQ(back.encoding, "mono8");
  EXPECT_EQ(back.data, image.data);
}

TEST(Wire, ListsRoundTrip) {
  Transforms transforms;
  transforms.transforms.resize(2);
  transforms.transforms[1].child_frame_id = "camera";
  transforms.transforms[1].transform.position = {1.0, 2.0, 3.0};
  const auto back = decode<Transforms>(bytes_of(transforms), "test");
  ASSERT_EQ(back.transforms.size(), 2U);
  EXPECT_EQ(back.transforms[1].child_frame_id, "camera");
  EXPECT_EQ(back.transforms[1].transform.position[2], 3.0);
}

TEST(Wire, RejectsEveryTruncation) {
  PointCloud2 cloud;
  cloud.point_fields = {{"x", 0, 7, 1}};
  cloud.data = {1, 2, 3, 4};
  const std::string whole = bytes_of(cloud);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_THROW(decode<PointCloud2>(whole.substr(0, size), "test"), DataError) << size;
  }
}

TEST(Wire, RejectsCountsBeyondData) {
  std::string bytes = bytes_of(Transforms{});
  bytes[3] = '\x7F';
  expect_in("promises", message_of<DataError>([&] { decode<Transforms>(bytes, "test"); }));
}

TEST(Wire, RejectsStampsOutOfRosRange) {
  Header header;
  header.stamp = Timestamp(-1);
  EXPECT_THROW(bytes_of(header), DataError);
  header.stamp = Timestamp(5'000'000'000LL * 1'000'000'000LL);
  EXPECT_THROW(bytes_of(header), DataError);
}

TEST(MessageTypes, DefinitionsIncludePartTypes) {
  const MessageType& type = message_type(kName<PointCloud2>);
  EXPECT_EQ(type.name, "sensor_msgs/PointCloud2");
  EXPECT_EQ(type.md5, "1158d486dd51d683ce2f1be655c3c181");
  expect_in("MSG: sensor_msgs/PointField\nuint8 INT8=1", type.definition);
}

}  // namespace
}  // namespace mms::msg
