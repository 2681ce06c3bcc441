#include "mms/dataset/capture/ouster_decoder.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

#include "mms/core/error.hpp"
#include "mms/core/size_text.hpp"

namespace mms {
namespace {

constexpr double kOusterUnit = 1e-3;
constexpr std::size_t kMeasurementAt = 8;  // of a column

/// Where a packet has its values.
struct OusterProfile {
  const char* name = "";
  std::size_t packet_header = 0;
  std::size_t column_header = 0;
  std::size_t column_footer = 0;
  std::size_t packet_footer = 0;
  std::size_t channel = 0;  // bytes of a pixel
  std::uint32_t range_mask = 0;
  std::uint32_t range_unit = 1;  // [mm]
  std::size_t reflectivity_at = 0;
};

constexpr OusterProfile kProfiles[] = {
    {"LEGACY", 0, 16, 4, 0, 12, 0x000FFFFF, 1, 4},
    {"RNG19_RFL8_SIG16_NIR16", 32, 12, 0, 32, 12, 0x0007FFFF, 1, 4},
    {"RNG19_RFL8_SIG16_NIR16_DUAL", 32, 12, 0, 32, 16, 0x0007FFFF, 1, 3},
    {"RNG15_RFL8_NIR8", 32, 12, 0, 32, 4, 0x00007FFF, 8, 2}};

const OusterProfile& profile_of(const std::string& name, const std::string& where) {
  for (const OusterProfile& profile : kProfiles) {
    if (name == profile.name) return profile;
  }
  throw DataError(where, "has packets of the profile " + name,
                  "known are LEGACY, RNG19_RFL8_SIG16_NIR16, RNG19_RFL8_SIG16_NIR16_DUAL and "
                  "RNG15_RFL8_NIR8");
}

/// Ouster's numbers are little-endian, as those of all machines this runs on.
template <class T>
T number_at(std::string_view packet, std::size_t at) {
  T value;
  std::memcpy(&value, packet.data() + at, sizeof value);
  return value;
}

class OusterDecoder final : public PacketDecoder {
 public:
  OusterDecoder(OusterMetadata metadata, const OusterProfile& profile)
      : metadata_(std::move(metadata)), profile_(profile) {
    const auto pixels = static_cast<std::size_t>(metadata_.pixels_per_column);
    column_size_ = profile_.column_header + pixels * profile_.channel + profile_.column_footer;
    packet_size_ = profile_.packet_header + columns() * column_size_ + profile_.packet_footer;
  }

  std::vector<std::string> facts() const override {
    return {"sensor: LiDAR, Ouster " + metadata_.product + ", " +
            size_text(metadata_.pixels_per_column, metadata_.columns_per_frame) + ", " +
            profile_.name};
  }
  bool is_data(std::string_view packet) const override { return packet.size() == packet_size_; }
  std::size_t columns() const override {
    return static_cast<std::size_t>(metadata_.columns_per_packet);
  }
  Duration clock_period() const override { return Duration::zero(); }

  std::optional<std::size_t> rotation_start(std::string_view packet) override {
    // Of a packet header, or of the first column.
    constexpr std::size_t kFrameAt = 2;
    constexpr std::size_t kLegacyFrameAt = 10;
    const auto frame =
        number_at<std::uint16_t>(packet, profile_.packet_header > 0 ? kFrameAt : kLegacyFrameAt);
    const bool is_new = frame_ && *frame_ != frame;
    frame_ = frame;
    return is_new ? std::optional<std::size_t>(0) : std::nullopt;
  }

  Duration clock(std::string_view packet, std::size_t column) const override {
    return Duration(number_at<std::int64_t>(packet, column_at(column)));
  }

  void append(std::string_view packet, std::size_t first, std::size_t last, Duration begin,
              LidarScan& scan) const override {
    for (std::size_t i = first; i < last; ++i) {
      if (!is_valid(packet, i)) continue;
      const auto measurement = number_at<std::uint16_t>(packet, column_at(i) + kMeasurementAt);
      const double encoder = 2.0 * std::numbers::pi *
                             (1.0 - static_cast<double>(measurement) / metadata_.columns_per_frame);
      const auto time = static_cast<float>(to_seconds(clock(packet, i) - begin));
      for (std::size_t k = 0; k < metadata_.beam_altitude.size(); ++k) {
        const std::size_t at = column_at(i) + profile_.column_header + k * profile_.channel;
        const std::uint32_t range = range_at(packet, at);
        if (range == 0) continue;  // no return
        scan.points.push_back(point_at(kOusterUnit * range, k, encoder));
        scan.intensity.push_back(
            static_cast<float>(number_at<std::uint8_t>(packet, at + profile_.reflectivity_at)));
        scan.time_offset.push_back(time);
      }
    }
  }

 private:
  std::size_t column_at(std::size_t column) const {
    return profile_.packet_header + column * column_size_;
  }

  bool is_valid(std::string_view packet, std::size_t column) const {
    constexpr std::size_t kStatusAt = 10;
    if (profile_.column_footer > 0) {
      const std::size_t at = column_at(column) + column_size_ - profile_.column_footer;
      return number_at<std::uint32_t>(packet, at) == 0xFFFFFFFF;
    }
    return (number_at<std::uint16_t>(packet, column_at(column) + kStatusAt) & 1U) != 0;
  }

  /// [mm]
  std::uint32_t range_at(std::string_view packet, std::size_t at) const {
    // A pixel of the smallest profile has four bytes.
    return (number_at<std::uint32_t>(packet, at) & profile_.range_mask) * profile_.range_unit;
  }

  /// Formula of the sensors' software manual, "Lidar range to XYZ".
  Eigen::Vector3f point_at(double range, std::size_t beam, double encoder) const {
    const double length = range - metadata_.beam_origin.norm();
    const double angle = encoder - metadata_.beam_azimuth[beam];
    const double altitude = metadata_.beam_altitude[beam];
    const double across = length * std::cos(altitude);
    const Eigen::Vector3d point(
        across * std::cos(angle) + metadata_.beam_origin.x() * std::cos(encoder),
        across * std::sin(angle) + metadata_.beam_origin.x() * std::sin(encoder),
        length * std::sin(altitude) + metadata_.beam_origin.y());
    return (metadata_.T_sensor_lidar * point).cast<float>();
  }

  OusterMetadata metadata_;
  OusterProfile profile_;
  std::size_t column_size_ = 0;  // [bytes]
  std::size_t packet_size_ = 0;  // [bytes]
  std::optional<std::uint16_t> frame_;
};

}  // namespace

std::unique_ptr<PacketDecoder> make_ouster_decoder(OusterMetadata metadata,
                                                   const std::string& where) {
  const OusterProfile& profile = profile_of(metadata.profile, where);
  return std::make_unique<OusterDecoder>(std::move(metadata), profile);
}

}  // namespace mms
