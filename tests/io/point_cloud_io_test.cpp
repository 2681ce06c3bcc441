#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "mms/core/error.hpp"
#include "mms/io/cloud/lzf.hpp"
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
    cloud.intensities.push_back(static_cast<float>(i));
    cloud.time_offsets.push_back(1e-3F * static_cast<float>(i));
  }
  return cloud;
}

void expect_equal(const PointCloudFile& a, const PointCloudFile& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.colors, b.colors);
  EXPECT_EQ(a.labels, b.labels);
  EXPECT_EQ(a.observations, b.observations);
  EXPECT_EQ(a.intensities, b.intensities);
  EXPECT_EQ(a.time_offsets, b.time_offsets);
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

/// Columns of 40 points, compressed by LibLZF: x y z, a field of two bytes, and an index.
const char* const kCompressed =
    "010000e0070001803fe00503010040e005030040200fe003030080200fe0030300a0200fe0030300c0200fe0"
    "030300e0200fe00303010041e005030010200fe003030020202fe09303400001803e2005213700402003413f"
    "00a0200700c0200300e020034000e0721f010102e04402204c1f030405060708090a0b0c0d0e0f1011121314"
    "15161718191a1b1c1d1e1f202122042324252627";

std::string bytes_of(std::string_view hex) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16));
  }
  return bytes;
}

/// @param size  of the data before compression, as the file states it
std::string compressed_pcd(const std::string& data, std::uint32_t size, int points = 40) {
  const auto compressed = static_cast<std::uint32_t>(data.size());
  std::string sizes(8, '\0');
  std::memcpy(sizes.data(), &compressed, 4);
  std::memcpy(sizes.data() + 4, &size, 4);
  return "VERSION 0.7\nFIELDS x y z _ intensity\nSIZE 4 4 4 1 1\nTYPE F F F U U\nCOUNT 1 1 1 2 1\n"
         "POINTS " +
         std::to_string(points) + "\nDATA binary_compressed\n" + sizes + data;
}

TEST(Pcd, ReadsCompressedPoints) {
  const TempFolder folder;
  const PointCloudFile cloud =
      read_pcd(folder.write("a.pcd", compressed_pcd(bytes_of(kCompressed), 600)));
  ASSERT_EQ(cloud.points.size(), 40U);
  for (int i = 0; i < 40; ++i) {
    const auto at = static_cast<std::size_t>(i);
    EXPECT_EQ(cloud.points[at],
              Eigen::Vector3f(static_cast<float>(i / 4), 2.5F, 0.25F * static_cast<float>(i % 8)));
    EXPECT_EQ(cloud.intensities[at], static_cast<float>(i));
  }
}

TEST(Pcd, RejectsDamagedCompressedPoints) {
  const TempFolder folder;
  const std::string data = bytes_of(kCompressed);
  const std::pair<std::string, const char*> cases[] = {
      {compressed_pcd(data, 601), "have 601 bytes for 40 points of 15"},
      {compressed_pcd(data, 600, 41), "have 600 bytes for 41 points of 15"},
      {compressed_pcd(data, 4'294'967'295U, 286'331'153), "more than 32 times as many"},
      {compressed_pcd(data.substr(0, 100), 600), "cannot be decompressed"},
      {compressed_pcd(data, 600).substr(0, 200), "bytes of 152"},
  };
  for (const auto& [bytes, expected] : cases) {
    expect_in(expected, message_of<DataError>([&] { read_pcd(folder.write("a.pcd", bytes)); }));
  }
}

TEST(Lzf, Decompresses) {
  const std::string long_match = bytes_of("016161e0ff00e0ff00e0ff00e0c500026d6d73");
  EXPECT_EQ(decompress_lzf(long_match, 1003), std::string(1000, 'a') + "mms");
  EXPECT_FALSE(decompress_lzf(long_match, 1002));
  EXPECT_FALSE(decompress_lzf(long_match, 1004));
  EXPECT_FALSE(decompress_lzf(bytes_of("20"), 3));      // without a distance
  EXPECT_FALSE(decompress_lzf(bytes_of("2000"), 3));    // from before the start
  EXPECT_FALSE(decompress_lzf(bytes_of("e0"), 9));      // without a length
  EXPECT_FALSE(decompress_lzf(bytes_of("056161"), 6));  // fewer literals
  EXPECT_EQ(decompress_lzf("", 0), "");
}

TEST(PointCloudIo, ReadsIntensityAndTimeByTheirCustomaryNames) {
  const TempFolder folder;
  // as of an Ouster: reflectivity only counts without intensity
  const auto pcd = folder.write("a.pcd",
                                "VERSION 0.7\nFIELDS x y z reflectivity t intensity ring\n"
                                "SIZE 4 4 4 2 4 4 1\nTYPE F F F U U F U\nWIDTH 2\nHEIGHT 1\n"
                                "POINTS 2\nDATA ascii\n1 2 3 9 0 0.5 7\n1 2 3 9 50000000 0.25 8\n");
  EXPECT_EQ(read_pcd(pcd).intensities, (std::vector<float>{0.5F, 0.25F}));
  EXPECT_EQ(read_pcd(pcd).time_offsets, (std::vector<float>{0.0F, 0.05F}));
  const auto ply = folder.write("a.ply",
                                "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n"
                                "property float y\nproperty float z\nproperty double timestamp\n"
                                "property uchar reflectance\nend_header\n"
                                "1 2 3 1700000000.5 7\n1 2 3 1700000000.75 200\n");
  EXPECT_EQ(read_ply(ply).intensities, (std::vector<float>{7.0F, 200.0F}));
  EXPECT_EQ(read_ply(ply).time_offsets, (std::vector<float>{0.0F, 0.25F}));
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

/// Drivers store stamps of points so, also in fields that are not used.
TEST(Pcd, ReadsIntegersOf64Bits) {
  const TempFolder folder;
  std::string points;
  const auto put = [&points](auto value) {
    points.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const std::uint64_t time : {1'700'000'000'500'000'000U, 1'700'000'000'600'000'000U}) {
    for (const float coordinate : {1.0F, 2.0F, 3.0F}) put(coordinate);
    put(std::int64_t{-7});
    put(time);
  }
  const std::string header =
      "SIZE 4 4 4 8 8\nTYPE F F F I U\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA binary\n";
  const PointCloudFile unused =
      read_pcd(folder.write("a.pcd", "FIELDS x y z id other\n" + header + points));
  EXPECT_EQ(unused.points[1], Eigen::Vector3f(1, 2, 3));
  EXPECT_TRUE(unused.time_offsets.empty());
  const PointCloudFile timed =
      read_pcd(folder.write("a.pcd", "FIELDS x y z id timestamp\n" + header + points));
  ASSERT_EQ(timed.time_offsets.size(), 2U);
  EXPECT_NEAR(timed.time_offsets[0], 0.0F, 1e-6F);
  EXPECT_NEAR(timed.time_offsets[1], 0.1F, 1e-6F);
}

TEST(Pcd, RejectsInvalidHeaders) {
  const TempFolder folder;
  const std::string xyz = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n";
  const std::pair<std::string, const char*> cases[] = {
      {"hello\n", "the header does not end"},
      {"DATA binary\n", "missing FIELDS"},
      {xyz + "POINTS 5\nDATA zipped\n", "unsupported DATA 'zipped'"},
      {xyz + "POINTS 5\nDATA binary_compressed\n1234567", "compressed data are missing"},
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
