#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "mms/core/error.hpp"
#include "mms/io/cloud/pcd_io.hpp"
#include "mms/io/cloud/ply_io.hpp"
#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::expect_in;
using testing::message_of;
using testing::TempFolder;

PointCloudFile full_cloud() {
  PointCloudFile cloud;
  for (int i = 0; i < 100; ++i) {
    const auto byte = static_cast<std::uint8_t>(i * 2);
    cloud.points.push_back(Eigen::Vector3f::Random() * 50.0F);
    cloud.normals.push_back(Eigen::Vector3f::Random().normalized());
    cloud.colors.push_back({byte, 255, static_cast<std::uint8_t>(255 - byte)});
    cloud.labels.push_back(i % 7 - 1);
    cloud.observations.push_back(i * 1000);
  }
  return cloud;
}

void expect_equal(const PointCloudFile& a, const PointCloudFile& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.colors, b.colors);
  EXPECT_EQ(a.labels, b.labels);
  EXPECT_EQ(a.observations, b.observations);
}

TEST(PointCloudIo, RoundTripsExactly) {
  const TempFolder folder;
  PointCloudFile points_only;
  points_only.points = full_cloud().points;
  for (const PointCloudFile& cloud : {full_cloud(), points_only, PointCloudFile{}}) {
    write_ply(folder.path() / "a.ply", cloud);
    expect_equal(read_ply(folder.path() / "a.ply"), cloud);
    write_pcd(folder.path() / "a.pcd", cloud);
    expect_equal(read_pcd(folder.path() / "a.pcd"), cloud);
  }
}

TEST(PointCloudIo, WritesCommentsOfPly) {
  const TempFolder folder;
  const PointCloudFile cloud = full_cloud();  // random
  write_ply(folder.path() / "a.ply", cloud, {"frame: world", "units: m"});
  expect_equal(read_ply(folder.path() / "a.ply"), cloud);
  EXPECT_TRUE(read_file(folder.path() / "a.ply")
                  .starts_with("ply\nformat binary_little_endian 1.0\ncomment frame: world\n"
                               "comment units: m\nelement vertex 100\n"));
}

TEST(PointCloudIo, KeepsNonFinitePoints) {
  const TempFolder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  PointCloudFile cloud;
  cloud.points.emplace_back(nan, infinity, -infinity);
  write_ply(folder.path() / "a.ply", cloud);
  const Eigen::Vector3f read = read_ply(folder.path() / "a.ply").points[0];
  EXPECT_TRUE(std::isnan(read.x()));
  EXPECT_EQ(read.y(), infinity);
  EXPECT_EQ(read.z(), -infinity);
}

TEST(PointCloudIo, RejectsVectorsOfDifferentLength) {
  const TempFolder folder;
  PointCloudFile cloud = full_cloud();
  cloud.labels.pop_back();
  expect_in("100 points and 99 labels",
            message_of<DataError>([&] { write_ply(folder.path() / "a.ply", cloud); }));
  message_of<DataError>([&] { write_pcd(folder.path() / "a.pcd", cloud); });
  EXPECT_TRUE(list_folder(folder.path()).empty());
}

TEST(Ply, ReadsForeignAscii) {
  const TempFolder folder;
  const auto path =
      folder.write("a.ply",
                   "ply\r\nformat ascii 1.0\r\ncomment by hand\r\n"
                   "element vertex 2\r\nproperty double x\r\nproperty double y\r\n"
                   "property double z\r\nproperty float quality\r\n"
                   "property uchar red\r\nproperty uchar green\r\n"
                   "property uchar blue\r\nproperty uint label\r\nelement face 1\r\n"
                   "property list uchar int vertex_indices\r\nend_header\r\n"
                   "1 2 3 0.5 10 20 30 7\r\n-1.5 nan 1e30 0 0 0 255 0\r\n3 0 1 1\r\n");
  const PointCloudFile cloud = read_ply(path);
  ASSERT_EQ(cloud.points.size(), 2U);
  EXPECT_EQ(cloud.points[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_TRUE(std::isnan(cloud.points[1].y()));
  EXPECT_EQ(cloud.colors[1], (Rgb{0, 0, 255}));
  EXPECT_EQ(cloud.labels, (std::vector<std::int32_t>{7, 0}));
  EXPECT_TRUE(cloud.normals.empty());
}

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kBinary = "ply\nformat binary_little_endian 1.0\n";

TEST(Ply, RejectsInvalidHeadersBeforeAllocation) {
  const TempFolder folder;
  const std::pair<std::string, const char*> cases[] = {
      {"", "the header does not end"},
      {"png\n", "is not a PLY file"},
      {std::string(100000, 'x'), "the header does not end"},
      {"ply\nformat binary_big_endian 1.0\n", "unsupported PLY format 'binary_big_endian'"},
      {kBinary, "the header does not end"},
      {kBinary + "element vertex -1\n" + kXyz + "end_header\n", "'-1' is not a count"},
      {kBinary + "element vertex many\n" + kXyz + "end_header\n", "'many' is not a count"},
      {kBinary + "element vertex 9000000000000000000\n" + kXyz + "end_header\n0123456789ab",
       "promises 9000000000000000000 points, but has only the bytes of 1"},
      {"ply\nformat ascii 1.0\nelement vertex 1000000000\n" + kXyz + "end_header\n1 2 3\n",
       "promises 1000000000 points, but has space for"},
      {kBinary + "element vertex 1\nend_header\n", "misses x, y or z"},
      {kBinary + "element vertex 1\n" + kXyz + "property float x\nend_header\n", "duplicate"},
      {kBinary + "element vertex 1\nproperty list int int x\nend_header\n", "list properties"},
      {kBinary + "element vertex 1\nproperty text x\nend_header\n", "unknown property type"},
      {kBinary + "element face 1\nend_header\n", "the first element is not 'vertex'"},
      {kBinary + "property float x\nend_header\n", "unexpected 'property'"},
      {kBinary + "element vertex 1\n" + kXyz + "property float nx\nend_header\n", "only some of"},
      {kBinary + "element vertex 1\n" + kXyz + "property float red\nend_header\n", "uchar"},
  };
  for (const auto& [bytes, expected] : cases) {
    const auto path = folder.write("a.ply", bytes);
    const std::string message = message_of<DataError>([&] { read_ply(path); });
    expect_in(path.string(), message);
    expect_in(expected, message);
  }
}

TEST(Ply, RejectsValuesOutOfRange) {
  const TempFolder folder;
  const std::string head = "ply\nformat ascii 1.0\nelement vertex 1\n" + kXyz;
  const auto label =
      folder.write("a.ply", head + "property double label\nend_header\n0 0 0 1e10\n");
  expect_in("value 1e+10, allowed:", message_of<DataError>([&] { read_ply(label); }));
  const auto nan = folder.write("a.ply", head + "property float label\nend_header\n0 0 0 nan\n");
  message_of<DataError>([&] { read_ply(nan); });
  const auto word = folder.write("a.ply", head + "end_header\n0 zero 0\n");
  expect_in("'zero' at point 0 is not a number", message_of<DataError>([&] { read_ply(word); }));
  const auto truncated = folder.write("a.ply", head + "end_header\n100 2000\n");
  expect_in("ends before point 0", message_of<DataError>([&] { read_ply(truncated); }));
}

TEST(Pcd, ReadsAsciiWithPackedColors) {
  const TempFolder folder;
  const auto path = folder.write("a.pcd",
                                 "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rgb curvature\n"
                                 "SIZE 4 4 4 4 4\nTYPE F F F U F\nCOUNT 1 1 1 1 2\nWIDTH 1\n"
                                 "HEIGHT 1\nPOINTS 1\nDATA ascii\n1 2 3 16711935 0.1 0.2\n");
  const PointCloudFile cloud = read_pcd(path);
  EXPECT_EQ(cloud.points[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(cloud.colors[0], (Rgb{255, 0, 255}));
}

TEST(Pcd, RejectsInvalidHeaders) {
  const TempFolder folder;
  const std::string xyz = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n";
  const std::pair<std::string, const char*> cases[] = {
      {"hello\n", "the header does not end"},
      {"DATA binary\n", "missing FIELDS"},
      {xyz + "POINTS 5\nDATA binary_compressed\n", "unsupported DATA 'binary_compressed'"},
      {xyz + "POINTS 5\nDATA binary\n0123456789ab",
       "promises 5 points, but has only the bytes of 1"},
      {xyz + "POINTS\nDATA binary\n", "is not a count"},
      {xyz + "COUNT 1 1\nPOINTS 1\nDATA binary\n", "differ in length"},
      {xyz + "COUNT 1 1 1000000000000\nPOINTS 1\nDATA binary\n", "allowed: up to 4096"},
      {"FIELDS x\nSIZE 3\nTYPE F\nPOINTS 1\nDATA binary\n", "unknown TYPE and SIZE 'F3'"},
      {"FIELDS\nSIZE\nTYPE\nPOINTS 1\nDATA binary\n", "misses x, y or z"},
  };
  for (const auto& [bytes, expected] : cases) {
    const auto path = folder.write("a.pcd", bytes);
    expect_in(expected, message_of<DataError>([&] { read_pcd(path); }));
  }
}

}  // namespace
}  // namespace mms
