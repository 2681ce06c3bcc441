#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "mms/core/error.hpp"
#include "mms/core/random_stream.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "tests/dataset/capture_file.hpp"
#include "tests/dataset/recording.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

#if MMS_WITH_LIBPCAP
constexpr bool kHasCapture = true;
#else
constexpr bool kHasCapture = false;
#endif

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kWall = 10.0;     // radius of the cylinder around the sensor [m]
constexpr double kRotation = 0.1;  // [s]
const Timestamp kBegin(1'700'000'000'000'000'000);

/// How a model measures, in the words of its manual.
struct VelodyneSpec {
  std::uint8_t product = 0x22;
  double block_time = 110.592e-6;                // [s]
  double unit = 0.002;                           // [m]
  std::function<double(std::size_t)> elevation;  // of a channel [degrees]
  std::function<double(std::size_t)> azimuth = [](std::size_t) { return 0.0; };
  bool dual = false;
};

VelodyneSpec vlp16() {
  VelodyneSpec spec;
  spec.elevation = [](std::size_t channel) {
    const auto laser = static_cast<double>(channel % 16);
    return channel % 2 == 0 ? -15.0 + laser : laser;
  };
  return spec;
}

VelodyneSpec hdl32() {
  VelodyneSpec spec;
  spec.product = 0x21;
  spec.block_time = 46.08e-6;
  spec.elevation = [](std::size_t channel) {
    const double step = 4.0 / 3.0 * static_cast<double>(channel / 2);
    return step - (channel % 2 == 0 ? 30.0 + 2.0 / 3.0 : 9.0 + 1.0 / 3.0);
  };
  return spec;
}

/// Only two lasers return: number 29, which looks up by 15 degrees, and number 1.
VelodyneSpec vlp32c() {
  VelodyneSpec spec;
  spec.product = 0x28;
  spec.block_time = 55.296e-6;
  spec.unit = 0.004;
  spec.elevation = [](std::size_t channel) {
    return channel == 29 ? 15.0 : channel == 1 ? -1.0 : std::nan("");
  };
  spec.azimuth = [](std::size_t channel) { return channel == 29 ? -1.4 : -4.2; };
  return spec;
}

/// A data packet that begins at a time [s] after the rotation angle was 0. Its last return is the
/// wall; the strongest one, if any, is nearer.
std::string velodyne_packet(const VelodyneSpec& spec, double time) {
  std::string packet;
  for (std::size_t block = 0; block < 12; ++block) {
    const auto firing = static_cast<double>(spec.dual ? block / 2 : block);
    const double angle = 360.0 / kRotation * (time + firing * spec.block_time);
    put<std::uint16_t>(packet, 0xEEFF);
    put(packet, static_cast<std::uint16_t>(std::lround(100.0 * angle) % 36000));
    for (std::size_t channel = 0; channel < 32; ++channel) {
      const double elevation = spec.elevation(channel) * kDegree;
      const double distance = (spec.dual && block % 2 == 1 ? 3.0 : kWall) / std::cos(elevation);
      const bool returns = std::isfinite(elevation);
      put(packet, static_cast<std::uint16_t>(returns ? std::lround(distance / spec.unit) : 0));
      put(packet, static_cast<std::uint8_t>(channel));
    }
  }
  constexpr double kHour = 3600.0;
  constexpr double kClock = 3599.95;  // at the beginning: the hour ends within the first rotation
  put(packet, static_cast<std::uint32_t>(std::lround(1e6 * std::fmod(kClock + time, kHour))));
  put<std::uint8_t>(packet, spec.dual ? 0x39 : 0x37);
  put(packet, spec.product);
  return packet;
}

/// A capture from the rotation angle 0 on.
std::string velodyne_capture(const VelodyneSpec& spec, double rotations) {
  CaptureFile file;
  const double step = (spec.dual ? 6.0 : 12.0) * spec.block_time;
  for (double time = 0.0; time < rotations * kRotation; time += step) {
    const auto captured = kBegin + Duration(std::llround(1e9 * time));
    file.add(velodyne_packet(spec, time), captured, 2368);
    file.add(std::string(512, '\0'), captured, 8308);  // a position packet
  }
  return file.bytes();
}

class Capture : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!kHasCapture) GTEST_SKIP() << "built without libpcap";
  }

  std::filesystem::path write(const std::string& bytes) {
    folder_.write("x.pcap", bytes);
    return folder_.path() / "x.pcap";
  }

  TempFolder folder_;
};

/// All points must be on the wall, in the direction of the rotation at their time.
void expect_wall(const Frame& frame, const VelodyneSpec& spec) {
  ASSERT_EQ(frame.scan.time_offset.size(), frame.scan.points.size());
  ASSERT_EQ(frame.scan.intensity.size(), frame.scan.points.size());
  for (std::size_t i = 0; i < frame.scan.points.size(); ++i) {
    const Eigen::Vector3d point = frame.scan.points[i].cast<double>();
    const auto channel = static_cast<std::size_t>(frame.scan.intensity[i]);
    const double elevation = spec.elevation(channel) * kDegree;
    ASSERT_NEAR(point.head<2>().norm(), kWall, 0.003) << i;
    ASSERT_NEAR(point.z(), kWall * std::tan(elevation), 0.004) << i;
    const double angle =
        360.0 / kRotation * static_cast<double>(frame.scan.time_offset[i]) + spec.azimuth(channel);
    // Clockwise seen from above. Angles are in steps of 0.01 degrees, as is their difference.
    const double measured = -std::atan2(point.y(), point.x()) / kDegree;
    ASSERT_NEAR(std::remainder(measured - angle, 360.0), 0.0, 0.02) << i;
  }
}

TEST_F(Capture, DecodesVelodyneSensors) {
  for (const VelodyneSpec& spec : {vlp16(), hdl32(), vlp32c()}) {
    const Playback played(open_dataset(write(velodyne_capture(spec, 3.4))));
    ASSERT_EQ(played.frames.size(), 3U) << int{spec.product};
    for (std::size_t k = 0; k < 3; ++k) {
      const Frame& frame = played.frames[k];
      // A rotation begins with the first block after the angle 0.
      EXPECT_NEAR(to_seconds(frame.stamp - kBegin), kRotation * static_cast<double>(k), 0.0002);
      EXPECT_LT(to_seconds(kBegin + std::chrono::milliseconds(100 * k) - frame.stamp), 1e-6);
    }
    // Of the first rotation the angle is 0 at its stamp.
    expect_wall(played.frames[0], spec);
  }
}

TEST_F(Capture, CutsRotationsBetweenBlocks) {
  const VelodyneSpec spec = vlp16();
  const Playback played(open_dataset(write(velodyne_capture(spec, 2.5))));
  ASSERT_EQ(played.frames.size(), 2U);
  const auto blocks = static_cast<double>(played.frames[1].scan.points.size() / 32);
  EXPECT_NEAR(blocks, kRotation / spec.block_time, 1.0);
  EXPECT_EQ(played.frames[1].scan.points.size() % 32, 0U);
}

TEST_F(Capture, BeginsWithWholeRotation) {
  CaptureFile file;
  const VelodyneSpec spec = vlp16();
  for (double time = 0.06; time < 0.33; time += 12.0 * spec.block_time) {
    file.add(velodyne_packet(spec, time), kBegin + Duration(std::llround(1e9 * time)), 2368);
  }
  const Playback played(open_dataset(write(file.bytes())));
  ASSERT_EQ(played.frames.size(), 2U);
  EXPECT_NEAR(to_seconds(played.frames[0].stamp - kBegin), 0.1, 0.0002);
}

TEST_F(Capture, UsesLastOfTwoReturns) {
  VelodyneSpec spec = vlp16();
  spec.dual = true;
  const Playback played(open_dataset(write(velodyne_capture(spec, 1.2))));
  ASSERT_EQ(played.frames.size(), 1U);
  expect_wall(played.frames[0], spec);
}

TEST_F(Capture, ReadsRotationsInAnyOrder) {
  const auto path = write(velodyne_capture(vlp16(), 4.2));
  const Playback all(open_dataset(path));
  const auto source = open_dataset(path);
  source->skip(2);
  const auto frame = source->next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->stamp, all.frames[2].stamp);
  EXPECT_EQ(frame->scan.points, all.frames[2].scan.points);
}

TEST_F(Capture, NeedsCorrectionsOfHdl64) {
  CaptureFile file;
  for (int k = 0; k < 300; ++k) {
    std::string packet;
    for (int block = 0; block < 12; ++block) {
      put<std::uint16_t>(packet, block % 2 == 0 ? 0xEEFF : 0xDDFF);
      put(packet, static_cast<std::uint16_t>((120 * k + 20 * (block / 2)) % 36000));
      for (int channel = 0; channel < 32; ++channel) {
        put(packet, static_cast<std::uint16_t>(channel == 3 && block % 2 == 1 ? 2500 : 0));
        put<std::uint8_t>(packet, 7);
      }
    }
    packet.resize(1206, '\0');
    put_at(packet, 1200, static_cast<std::uint32_t>(288 * k));
    file.add(packet, kBegin + std::chrono::microseconds(288 * k), 2368);
  }
  const auto path = write(file.bytes());
  expect_in("x.pcap: is of an HDL-64E, each of which has its own corrections (add them as x.yaml",
            message_of<DataError>([&] { open_dataset(path); }));
  std::string yaml = "num_lasers: 64\nlasers:\n";
  for (int laser = 0; laser < 64; ++laser) {
    yaml += "- {laser_id: " + std::to_string(laser) +
            ", vert_correction: 0.3, rot_correction: 0.1, dist_correction: 0.5, focal_slope: 0, "
            "vert_offset_correction: 0.2, horiz_offset_correction: 0.03}\n";
  }
  folder_.write("x.yaml", yaml);
  const Frame frame = Playback(open_dataset(path)).frames.at(0);
  ASSERT_FALSE(frame.scan.points.empty());
  // 5 m and a correction of 0.5 m, in the direction -0.1 rad of a sensor that looks ahead.
  const double across = 5.5 * std::cos(0.3) - 0.2 * std::sin(0.3);
  const double right = across * std::sin(-0.1) - 0.03 * std::cos(-0.1);
  const double forward = across * std::cos(-0.1) + 0.03 * std::sin(-0.1);
  const double up = 5.5 * std::sin(0.3) + 0.2 * std::cos(0.3);
  EXPECT_LT((frame.scan.points[0] - Eigen::Vector3d(forward, -right, up).cast<float>()).norm(),
            1e-5F);
}

// ---------------------------------------------------------------- Ouster

constexpr int kPixels = 32;
constexpr int kColumns = 512;  // of a rotation
constexpr int kPacketColumns = 16;
constexpr double kBeamOrigin = 0.015;  // [m]

double altitude_of(int pixel) {
  return 20.0 - 1.25 * pixel;  // [degrees]
}

double azimuth_of_beam(int pixel) {
  return pixel % 2 == 0 ? 3.0 : -3.0;  // [degrees]
}

struct OusterSpec {
  const char* profile = "LEGACY";
  std::size_t header = 0;  // of a packet, and after it
  std::size_t column_header = 16;
  std::size_t column_footer = 4;
  std::size_t pixel = 12;  // [bytes]
  std::size_t reflectivity_at = 4;
  int unit = 1;  // [mm]
};

constexpr OusterSpec kOusterSpecs[] = {{},
                                       {"RNG19_RFL8_SIG16_NIR16", 32, 12, 0, 12, 4, 1},
                                       {"RNG19_RFL8_SIG16_NIR16_DUAL", 32, 12, 0, 16, 3, 1},
                                       {"RNG15_RFL8_NIR8", 32, 12, 0, 4, 2, 8}};

/// Range of a beam that leaves the circle of radius kBeamOrigin and meets the wall.
double range_of(int pixel) {
  const double azimuth = azimuth_of_beam(pixel) * kDegree;
  const double across = -kBeamOrigin * std::cos(azimuth) +
                        std::sqrt(kWall * kWall - std::pow(kBeamOrigin * std::sin(azimuth), 2));
  return across / std::cos(altitude_of(pixel) * kDegree) + kBeamOrigin;
}

/// @param clock  of the first column of the rotation [ns]
std::string ouster_packet(const OusterSpec& spec, int frame, int first, std::int64_t clock) {
  std::string packet(spec.header, '\0');
  if (spec.header > 0) put_at(packet, 2, static_cast<std::uint16_t>(frame));
  for (int column = first; column < first + kPacketColumns; ++column) {
    std::string bytes(spec.column_header + kPixels * spec.pixel, '\0');
    put_at(bytes, 0, clock + 100'000'000LL * column / kColumns);
    put_at(bytes, 8, static_cast<std::uint16_t>(column));
    put_at(bytes, 10, static_cast<std::uint16_t>(spec.header > 0 ? 1 : frame));
    for (int pixel = 0; pixel < kPixels; ++pixel) {
      const std::size_t at = spec.column_header + static_cast<std::size_t>(pixel) * spec.pixel;
      const auto range = std::lround(1000.0 * range_of(pixel) / spec.unit);
      if (spec.pixel == 4) {
        put_at(bytes, at, static_cast<std::uint16_t>(range));
      } else {
        put_at(bytes, at, static_cast<std::uint32_t>(range) | 0xF0000000U);  // with flags
      }
      put_at(bytes, at + spec.reflectivity_at, static_cast<std::uint8_t>(pixel));
    }
    // The last column of each packet is not valid.
    const bool valid = column + 1 < first + kPacketColumns;
    if (spec.header > 0) put_at(bytes, 10, static_cast<std::uint16_t>(valid ? 1 : 0));
    if (spec.column_footer > 0) put<std::uint32_t>(bytes, valid ? 0xFFFFFFFF : 0);
    packet += bytes;
  }
  return packet + std::string(spec.header, '\0');
}

std::string ouster_metadata(const OusterSpec& spec, bool grouped) {
  std::string altitudes;
  std::string azimuths;
  for (int pixel = 0; pixel < kPixels; ++pixel) {
    altitudes += (pixel == 0 ? "" : ", ") + std::to_string(altitude_of(pixel));
    azimuths += (pixel == 0 ? "" : ", ") + std::to_string(azimuth_of_beam(pixel));
  }
  const std::string beams = R"("beam_altitude_angles": [)" + altitudes +
                            R"(], "beam_azimuth_angles": [)" + azimuths +
                            R"(], "lidar_origin_to_beam_origin_mm": 15.0)";
  const std::string mount =
      R"("lidar_to_sensor_transform": [-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 36.18, 0, 0, 0, 1])";
  const std::string format =
      R"({"pixels_per_column": 32, "columns_per_packet": 16, "columns_per_frame": 512, )"
      R"("udp_profile_lidar": ")" +
      std::string(spec.profile) + "\"}";
  if (!grouped) {
    return R"({"prod_line": "OS-1-32", )" + beams + ", " + mount + R"(, "data_format": )" + format +
           "}";
  }
  return R"({"sensor_info": {"prod_line": "OS-1-32"}, "beam_intrinsics": {)" + beams +
         R"(}, "lidar_intrinsics": {)" + mount + R"(}, "lidar_data_format": )" + format + "}";
}

std::string ouster_capture(const OusterSpec& spec, int rotations, std::int64_t clock) {
  CaptureFile file;
  for (int k = 0; k < rotations; ++k) {
    for (int column = 0; column < kColumns; column += kPacketColumns) {
      const Duration time(100'000'000LL * k + 100'000'000LL * column / kColumns);
      file.add(ouster_packet(spec, 65534 + k, column, clock + 100'000'000LL * k), kBegin + time,
               7502);
    }
  }
  return file.bytes();
}

TEST_F(Capture, DecodesProfilesOfOuster) {
  bool grouped = false;
  for (const OusterSpec& spec : kOusterSpecs) {
    folder_.write("x.json", ouster_metadata(spec, grouped));
    grouped = !grouped;
    const Playback played(open_dataset(write(ouster_capture(spec, 3, 5'000'000'000))));
    ASSERT_EQ(played.frames.size(), 3U) << spec.profile;
    EXPECT_TRUE(any_has(played.source->describe(), "sensor: LiDAR, Ouster OS-1-32, 32x512"));
    EXPECT_EQ(played.frames[2].stamp, kBegin + std::chrono::milliseconds(200));
    const LidarScan& scan = played.frames[1].scan;
    ASSERT_EQ(scan.points.size(), std::size_t{kColumns} / 16 * 15 * kPixels) << spec.profile;
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
      const Eigen::Vector3d point = scan.points[i].cast<double>();
      const int pixel = static_cast<int>(scan.intensity[i]);
      const double altitude = altitude_of(pixel) * kDegree;
      ASSERT_NEAR(point.head<2>().norm(), kWall, 0.001 * spec.unit) << spec.profile;
      ASSERT_NEAR(point.z(), (range_of(pixel) - kBeamOrigin) * std::sin(altitude) + 0.03618,
                  0.001 * spec.unit);
      // Clockwise from behind, where the cable is.
      const double encoder = 360.0 * (1.0 - 10.0 * static_cast<double>(scan.time_offset[i]));
      const double angle = encoder - azimuth_of_beam(pixel) + 180.0;
      const double measured = std::atan2(point.y(), point.x()) / kDegree;
      ASSERT_NEAR(std::remainder(measured - angle, 360.0), 0.0, 0.01) << spec.profile;
    }
  }
}

TEST_F(Capture, TakesStampsOfSynchronizedSensor) {
  const OusterSpec spec;
  folder_.write("other_name.json", ouster_metadata(spec, true));
  const std::int64_t clock = 1'600'000'000'000'000'000;
  const Playback played(open_dataset(write(ouster_capture(spec, 2, clock))));
  ASSERT_EQ(played.frames.size(), 2U);
  EXPECT_EQ(played.frames[1].stamp, Timestamp(clock + 100'000'000));
}

TEST_F(Capture, ReadsGroundTruthBeside) {
  folder_.write("x.groundtruth.txt", "1700000000.1 1 2 3 0 0 0 1\n");
  const auto source = open_dataset(write(velodyne_capture(vlp16(), 2.2)));
  EXPECT_EQ(source->ground_truth().size(), 1U);
}

TEST_F(Capture, ErrorsNameTheFault) {
  const auto message = [&](const std::string& bytes) {
    const auto path = write(bytes);
    return message_of<DataError>([&] { open_dataset(path); });
  };
  expect_in("x.pcap: is no capture that libpcap reads", message("not a capture"));
  expect_in("no data packets of a Velodyne or an Ouster, but no UDP datagrams",
            message(CaptureFile().bytes()));
  const std::string ouster = ouster_capture({}, 1, 0);
  expect_in("but UDP datagrams of 6464 bytes (32) (an Ouster's needs its metadata, as x.json",
            message(ouster));
  folder_.write("x.json", "{\"beam_altitude_angles\": [1]}");
  expect_in("x.json: has no 'lidar_mode' (expected the metadata of an Ouster sensor)",
            message(ouster));
  folder_.write("x.json", ouster_metadata(kOusterSpecs[1], true));
  expect_in("is x.json of this recording?", message(ouster));
  VelodyneSpec unknown = vlp16();
  unknown.product = 0x63;
  expect_in("a Velodyne sensor with product number 99 (known are VLP-16",
            message(velodyne_capture(unknown, 0.1)));
}

TEST_F(Capture, WarnsOfTruncatedFile) {
  const std::string bytes = velodyne_capture(vlp16(), 3.2);
  const Playback played(open_dataset(write(bytes.substr(0, bytes.size() - 700))));
  EXPECT_EQ(played.frames.size(), 3U);
  EXPECT_TRUE(any_has(played.warnings, "x.pcap: is damaged or truncated"));
}

/// Opens and plays a damaged capture: frames and an mms::Error are allowed, everything else is a
/// failure.
void expect_survives(const std::filesystem::path& capture) {
  try {
    const Playback played(open_dataset(capture));
    for (const Frame& frame : played.frames) {
      EXPECT_EQ(frame.scan.time_offset.size(), frame.scan.points.size());
    }
  } catch (const Error&) {
  }
}

/// With some bytes changed, half of them among the first 200, or the end cut off.
std::string damaged(std::string bytes, RandomStream& random) {
  if (random.chance(0.2F)) return bytes.substr(0, random.below(bytes.size()));
  for (int i = 0; i < 8; ++i) {
    const std::size_t end =
        random.chance(0.5F) ? std::min<std::size_t>(200, bytes.size()) : bytes.size();
    bytes[random.below(end)] = static_cast<char>(random.chance(0.5F) ? 0xFF : random.bits());
  }
  return bytes;
}

TEST_F(Capture, DamagedCapturesOfVelodyneAreSurvived) {
  const std::string whole = velodyne_capture(vlp16(), 1.5);
  RandomStream random(1);
  for (int i = 0; i < 300; ++i) expect_survives(write(damaged(whole, random)));
}

TEST_F(Capture, DamagedCapturesOfOusterAreSurvived) {
  RandomStream random(2);
  for (const OusterSpec& spec : kOusterSpecs) {
    const std::string whole = ouster_capture(spec, 2, 0);
    folder_.write("x.json", ouster_metadata(spec, true));
    for (int i = 0; i < 100; ++i) expect_survives(write(damaged(whole, random)));
  }
}

TEST_F(Capture, DamagedMetadataOfOusterIsSurvived) {
  RandomStream random(3);
  write(ouster_capture(kOusterSpecs[1], 2, 0));
  const std::string whole = ouster_metadata(kOusterSpecs[1], false);
  for (int i = 0; i < 300; ++i) {
    std::string text = whole;
    // Mostly digits, so that it stays JSON with other numbers.
    for (int k = 0; k < 4; ++k)
      text[random.below(text.size())] = "0123456789-.e\"[]{}"[random.below(18)];
    folder_.write("x.json", text);
    expect_survives(folder_.path() / "x.pcap");
  }
}

}  // namespace
}  // namespace mms
