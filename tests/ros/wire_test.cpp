#include "mms/ros/wire.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/ros/display_messages.hpp"
#include "mms/ros/message_types.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms::msg {
namespace {

using namespace mms::testing;  // NOLINT: helpers of the tests

template <class Message>
std::string bytes_of(const Message& message, WireFormat format = WireFormat::kRos1) {
  std::string bytes(encoded_size(message, format), '\0');
  encode(message, reinterpret_cast<std::uint8_t*>(bytes.data()), format);
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

/// Two transforms in CDR, laid out by hand after DDS-XTypes 7.4.1.
struct CdrTransforms {
  explicit CdrTransforms(bool big_endian) : big_endian_(big_endian) {
    bytes = big_endian ? std::string("\0\0\0\0", 4) : std::string("\0\1\0\0", 4);
    number(std::uint32_t{2});
    for (const std::string frame : {"ab", "abcde"}) {
      align(4);
      number(std::uint32_t{3});
      number(std::uint32_t{5});
      text(frame);
      align(4);
      text("c");
      align(8);
      for (const double value : {1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 1.0}) number(value);
    }
  }
  void align(std::size_t size) {
    while ((bytes.size() - 4) % size != 0) bytes += '\0';
  }
  template <class T>
  void number(T value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    if (big_endian_) std::reverse(std::begin(raw), std::end(raw));
    bytes.append(raw, sizeof value);
  }
  void text(const std::string& text) {
    number(static_cast<std::uint32_t>(text.size() + 1));
    bytes += text + '\0';
  }
  std::string bytes;
  bool big_endian_;
};

TEST(Cdr, ReadsBothByteOrders) {
  for (const bool big_endian : {false, true}) {
    const std::string bytes = CdrTransforms(big_endian).bytes;
    const auto read = decode<Transforms>(bytes, "test", WireFormat::kCdr);
    ASSERT_EQ(read.transforms.size(), 2U);
    EXPECT_EQ(read.transforms[1].header.stamp, Timestamp(3'000'000'005));
    EXPECT_EQ(read.transforms[1].header.frame_id, "abcde");
    EXPECT_EQ(read.transforms[0].child_frame_id, "c");
    EXPECT_EQ(read.transforms[1].transform.position[2], 3.0);
    if (!big_endian) {
      EXPECT_EQ(bytes_of(read, WireFormat::kCdr), bytes);
    }
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      EXPECT_THROW(decode<Transforms>(bytes.substr(0, size), "test", WireFormat::kCdr), DataError);
    }
  }
}

TEST(Cdr, MessagesRoundTrip) {
  CameraInfo camera;
  camera.header.frame_id = "camera";
  camera.distortion_model = "plumb_bob";
  camera.D = {0.1, 0.2};
  camera.P[11] = 7.0;
  camera.do_rectify = true;
  for (const bool lens : {true, false}) {
    if (!lens) camera.D.clear();
    const auto back =
        decode<CameraInfo>(bytes_of(camera, WireFormat::kCdr), "test", WireFormat::kCdr);
    EXPECT_EQ(back.D, camera.D);
    EXPECT_EQ(back.P, camera.P);
    EXPECT_TRUE(back.do_rectify);
  }
  PointCloud2 cloud;
  cloud.point_fields = {{"x", 0, 7, 1}, {"intensity", 4, 7, 1}};
  cloud.data = {1, 2, 3};
  cloud.is_dense = true;
  const auto back =
      decode<PointCloud2>(bytes_of(cloud, WireFormat::kCdr), "test", WireFormat::kCdr);
  EXPECT_EQ(back.point_fields[1].name, "intensity");
  EXPECT_EQ(back.point_fields[1].offset, 4U);
  EXPECT_EQ(back.data, cloud.data);
  EXPECT_TRUE(back.is_dense);
}

TEST(Cdr, RejectsOtherRepresentations) {
  std::string bytes = bytes_of(Image{}, WireFormat::kCdr);
  bytes[1] = 3;
  expect_in("test: has the CDR representation 3, expected 0 or 1",
            message_of<DataError>([&] { decode<Image>(bytes, "test", WireFormat::kCdr); }));
}

TEST(Cdr, RejectsCountsBeyondData) {
  std::string bytes = bytes_of(Transforms{}, WireFormat::kCdr);
  bytes[7] = '\x7F';
  expect_in("promises",
            message_of<DataError>([&] { decode<Transforms>(bytes, "test", WireFormat::kCdr); }));
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

TEST(MessageTypes, DefinitionsOfRos2HaveItsNames) {
  const std::string& camera = message_type(kName<CameraInfo>).ros2_definition;
  EXPECT_TRUE(camera.starts_with("std_msgs/Header header\n"));
  expect_in("float64[9] k\n", camera);
  expect_in("MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n", camera);
  expect_in("MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n", camera);
  const std::string& markers = message_type(kName<MarkerArray>).ros2_definition;
  expect_in("int32 CUBE=1\n", markers);
  expect_in("builtin_interfaces/Duration lifetime\n", markers);
  expect_in("UVCoordinate[] uv_coordinates\nstring text\n", markers);
  expect_in("MeshFile mesh_file\nbool mesh_use_embedded_materials\n", markers);
  expect_in("MSG: visualization_msgs/MeshFile\nstring filename\nuint8[] data\n", markers);
}

TEST(Wire, MarkersOfRos2HaveTheirOwnFields) {
  Marker marker;
  marker.text = "person 1";
  marker.mesh_use_embedded_materials = true;
  const std::size_t ros1 = encoded_size(marker, WireFormat::kRos1);
  std::string bytes(encoded_size(marker, WireFormat::kCdr), '\0');
  encode(marker, reinterpret_cast<std::uint8_t*>(bytes.data()), WireFormat::kCdr);
  EXPECT_GT(bytes.size(), ros1 + 20);
  const auto read = decode<Marker>(bytes, "marker", WireFormat::kCdr);
  EXPECT_EQ(read.text, marker.text);
  EXPECT_TRUE(read.mesh_use_embedded_materials);
}

}  // namespace
}  // namespace mms::msg
