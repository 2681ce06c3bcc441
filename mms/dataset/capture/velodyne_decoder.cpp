#include "mms/dataset/capture/velodyne_decoder.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "mms/core/error.hpp"

namespace mms {
namespace {

constexpr std::size_t kPacket = 1206;  // [bytes]
constexpr std::size_t kBlocks = 12;
constexpr std::size_t kBlock = 100;     // [bytes]
constexpr std::size_t kChannels = 32;   // of a block
constexpr std::size_t kClockAt = 1200;  // microseconds since the full hour
constexpr std::size_t kReturnModeAt = 1204;
constexpr std::size_t kProductAt = 1205;
constexpr std::uint16_t kUpperBlock = 0xEEFF;
constexpr std::uint16_t kLowerBlock = 0xDDFF;  // of an HDL-64E
constexpr std::uint8_t kDualReturn = 0x39;
constexpr int kTurn = 36000;     // [0.01 degrees]
constexpr int kMaxStep = 300;    // between blocks; more is a gap in the field of view
constexpr int kMinReturn = 100;  // back to the beginning of the rotation
constexpr double kRadians = std::numbers::pi / 180.0;
constexpr double kMicrosecond = 1e-6;

/// How a channel of a block is measured.
struct Channel {
  double elevation = 0.0;          // [rad]
  double azimuth = 0.0;            // added to the rotation [rad]
  double time = 0.0;               // after the beginning of the block [us]
  double distance = 0.0;           // added [m]
  double vertical_offset = 0.0;    // [m]
  double horizontal_offset = 0.0;  // [m]
};

struct VelodyneModel {
  const char* name = "";
  double unit = 0.002;                // of distances [m]
  double block_time = 0.0;            // [us]
  std::size_t blocks_per_firing = 1;  // two have the same rotation angle
  std::vector<Channel> channels;      // of the blocks of a firing
};

/// VLP-16 and Puck Hi-Res: a block has two firings of 16 lasers.
VelodyneModel make_vlp16(const char* name, const std::array<double, 16>& elevations) {
  constexpr double kLaser = 2.304;    // [us]
  constexpr double kFiring = 55.296;  // [us]
  VelodyneModel model;
  model.name = name;
  model.block_time = 2.0 * kFiring;
  for (std::size_t i = 0; i < kChannels; ++i) {
    const std::size_t laser = i % 16;
    const double time = kFiring * static_cast<double>(i / 16) + kLaser * static_cast<double>(laser);
    model.channels.push_back({.elevation = elevations[laser] * kRadians, .time = time});
  }
  return model;
}

/// Lasers alternate between a lower bank from -30.67 and an upper bank from -9.33 degrees on.
VelodyneModel make_hdl32() {
  constexpr double kLaser = 1.152;  // [us]
  constexpr double kStep = 4.0 / 3.0;
  VelodyneModel model;
  model.name = "HDL-32E";
  model.block_time = 46.08;
  for (std::size_t i = 0; i < kChannels; ++i) {
    const double elevation =
        (i % 2 == 0 ? -92.0 / 3.0 : -28.0 / 3.0) + kStep * static_cast<double>(i / 2);
    model.channels.push_back(
        {.elevation = elevation * kRadians, .time = kLaser * static_cast<double>(i)});
  }
  return model;
}

/// Two lasers fire at a time.
VelodyneModel make_vlp32c() {
  constexpr double kPair = 2.304;  // [us]
  constexpr std::array<double, kChannels> kElevations = {
      -25.0,  -1.0,   -1.667, -15.639, -11.31, 0.0,    -0.667, -8.843, -7.254, 0.333,  -0.333,
      -6.148, -5.333, 1.333,  0.667,   -4.0,   -4.667, 1.667,  1.0,    -3.667, -3.333, 3.333,
      2.333,  -2.667, -3.0,   7.0,     4.667,  -2.333, -2.0,   15.0,   10.333, -1.333};
  constexpr std::array<double, kChannels> kAzimuths = {
      1.4, -4.2, 1.4, -1.4, 1.4, -1.4, 4.2, -1.4, 1.4, -4.2, 1.4, -1.4, 4.2, -1.4, 4.2, -1.4,
      1.4, -4.2, 1.4, -4.2, 4.2, -1.4, 1.4, -1.4, 1.4, -1.4, 1.4, -4.2, 4.2, -1.4, 1.4, -1.4};
  VelodyneModel model;
  model.name = "VLP-32C";
  model.unit = 0.004;
  model.block_time = 55.296;
  for (std::size_t i = 0; i < kChannels; ++i) {
    model.channels.push_back({.elevation = kElevations[i] * kRadians,
                              .azimuth = kAzimuths[i] * kRadians,
                              .time = kPair * static_cast<double>(i / 2)});
  }
  return model;
}

/// Two blocks, of the upper and the lower lasers, are a firing.
VelodyneModel make_hdl64(const std::vector<LaserCorrection>& corrections) {
  VelodyneModel model;
  model.name = "HDL-64E";
  model.block_time = 48.0;
  model.blocks_per_firing = 2;
  for (const LaserCorrection& laser : corrections) {
    model.channels.push_back({.elevation = laser.elevation,
                              .azimuth = -laser.azimuth,
                              .distance = laser.distance,
                              .vertical_offset = laser.vertical_offset,
                              .horizontal_offset = laser.horizontal_offset});
  }
  return model;
}

VelodyneModel model_of(std::string_view packet, const std::vector<LaserCorrection>& corrections,
                       const std::string& where) {
  if (is_hdl64_packet(packet)) return make_hdl64(corrections);
  switch (static_cast<std::uint8_t>(packet[kProductAt])) {
    case 0x21:
      return make_hdl32();
    case 0x22:
      return make_vlp16("VLP-16", {-15, 1, -13, 3, -11, 5, -9, 7, -7, 9, -5, 11, -3, 13, -1, 15});
    case 0x24:
      return make_vlp16("Puck Hi-Res",
                        {-10.0, 2.0 / 3, -26.0 / 3, 2.0, -22.0 / 3, 10.0 / 3, -6.0, 14.0 / 3,
                         -14.0 / 3, 6.0, -10.0 / 3, 22.0 / 3, -2.0, 26.0 / 3, -2.0 / 3, 10.0});
    case 0x28:
      return make_vlp32c();
    default:
      throw DataError(where,
                      "has packets of a Velodyne sensor with product number " +
                          std::to_string(static_cast<std::uint8_t>(packet[kProductAt])),
                      "known are VLP-16, Puck Hi-Res, HDL-32E, VLP-32C and HDL-64E");
  }
}

template <class T>
T little_endian(std::string_view packet, std::size_t at) {
  T value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    value = static_cast<T>(value |
                           (static_cast<T>(static_cast<std::uint8_t>(packet[at + i])) << (8 * i)));
  }
  return value;
}

/// Rotation angle of a block [0.01 degrees].
int azimuth_of(std::string_view packet, std::size_t block) {
  return little_endian<std::uint16_t>(packet, kBlock * block + 2) % kTurn;
}

class VelodyneDecoder final : public PacketDecoder {
 public:
  VelodyneDecoder(VelodyneModel model, std::string_view packet)
      : model_(std::move(model)), dual_(packet[kReturnModeAt] == kDualReturn) {
    if (model_.blocks_per_firing == 2) dual_ = false;
    step_ = dual_ ? 2 : model_.blocks_per_firing;
  }

  std::vector<std::string> facts() const override {
    std::vector<std::string> lines = {std::string("sensor: LiDAR, Velodyne ") + model_.name};
    if (dual_) lines.emplace_back("returns: two, the last one is used");
    return lines;
  }
  bool is_data(std::string_view packet) const override { return is_velodyne_packet(packet); }
  std::size_t columns() const override { return kBlocks / step_; }
  Duration clock_period() const override { return std::chrono::hours(1); }

  std::optional<std::size_t> rotation_start(std::string_view packet) override {
    std::optional<std::size_t> start;
    for (std::size_t i = 0; i < columns(); ++i) {
      const int azimuth = azimuth_of(packet, i * step_);
      if (azimuth < last_azimuth_ - kMinReturn) start = i;
      last_azimuth_ = azimuth;
    }
    return start;
  }

  Duration clock(std::string_view packet, std::size_t column) const override {
    const auto begin = std::chrono::microseconds(little_endian<std::uint32_t>(packet, kClockAt));
    const double since = 1e3 * model_.block_time * static_cast<double>(column);  // [ns]
    return begin + Duration(std::llround(since));
  }

  void append(std::string_view packet, std::size_t first, std::size_t last, Duration begin,
              LidarScan& scan) const override {
    for (std::size_t i = first; i < last; ++i) {
      const double time = to_seconds(elapsed(begin, clock(packet, i), clock_period()));
      const double azimuth = 0.01 * kRadians * azimuth_of(packet, i * step_);
      const double turned = 0.01 * kRadians * turn_after(packet, i);
      for (std::size_t c = 0; c < model_.channels.size(); ++c) {
        const std::size_t at = kBlock * (i * step_ + c / kChannels) + 4 + 3 * (c % kChannels);
        const auto raw = little_endian<std::uint16_t>(packet, at);
        if (raw == 0) continue;  // no return
        const Channel& channel = model_.channels[c];
        const double share = channel.time / model_.block_time;
        scan.points.push_back(
            point_at(channel, model_.unit * raw, azimuth + share * turned + channel.azimuth));
        scan.intensity.push_back(static_cast<float>(static_cast<std::uint8_t>(packet[at + 2])));
        scan.time_offset.push_back(static_cast<float>(time + kMicrosecond * channel.time));
      }
    }
  }

 private:
  /// Rotation from a column to the next one [0.01 degrees]; that before for the last one.
  int turn_after(std::string_view packet, std::size_t column) const {
    const std::size_t from = column + 1 < columns() ? column : column - 1;
    const auto turn_of = [&](std::size_t i) {
      return (azimuth_of(packet, (i + 1) * step_) - azimuth_of(packet, i * step_) + kTurn) % kTurn;
    };
    const int turn = turn_of(from);
    if (turn <= kMaxStep) return turn;
    return from > 0 && turn_of(from - 1) <= kMaxStep ? turn_of(from - 1) : 0;
  }

  /// The manuals' axes are x right, y forward; ours are x forward, y left.
  static Eigen::Vector3f point_at(const Channel& channel, double distance, double azimuth) {
    distance += channel.distance;
    const double across = distance * std::cos(channel.elevation) -
                          channel.vertical_offset * std::sin(channel.elevation);
    const double right = across * std::sin(azimuth) - channel.horizontal_offset * std::cos(azimuth);
    const double forward =
        across * std::cos(azimuth) + channel.horizontal_offset * std::sin(azimuth);
    const double up = distance * std::sin(channel.elevation) +
                      channel.vertical_offset * std::cos(channel.elevation);
    return Eigen::Vector3d(forward, -right, up).cast<float>();
  }

  VelodyneModel model_;
  bool dual_ = false;
  std::size_t step_ = 1;   // blocks of a column
  int last_azimuth_ = -1;  // [0.01 degrees]
};

}  // namespace

bool is_velodyne_packet(std::string_view packet) {
  if (packet.size() != kPacket) return false;
  for (std::size_t i = 0; i < kBlocks; ++i) {
    const auto flag = little_endian<std::uint16_t>(packet, kBlock * i);
    if (flag != kUpperBlock && flag != kLowerBlock) return false;
  }
  return true;
}

bool is_hdl64_packet(std::string_view packet) {
  return little_endian<std::uint16_t>(packet, kBlock) == kLowerBlock;
}

std::unique_ptr<PacketDecoder> make_velodyne_decoder(std::string_view packet,
                                                     std::vector<LaserCorrection> corrections,
                                                     const std::string& where) {
  return std::make_unique<VelodyneDecoder>(model_of(packet, corrections, where), packet);
}

}  // namespace mms
