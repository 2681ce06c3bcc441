#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mms/core/frame.hpp"

namespace mms {

/// Decodes the data packets of a rotating LiDAR. A packet has columns, which are measured at about
/// the same time.
class PacketDecoder {
 public:
  virtual ~PacketDecoder() = default;

  /// Facts about the sensor, one per line.
  virtual std::vector<std::string> facts() const = 0;

  /// Whether a datagram is a data packet. Only such packets are allowed below.
  virtual bool is_data(std::string_view packet) const = 0;

  /// Number of columns in every packet.
  virtual std::size_t columns() const = 0;

  /// The column with which a rotation begins, compared with the packet of the previous call.
  virtual std::optional<std::size_t> rotation_start(std::string_view packet) = 0;

  /// The sensor's clock at a column.
  virtual Duration clock(std::string_view packet, std::size_t column) const = 0;
  /// Time after which the clock begins again; 0 if it does not.
  virtual Duration clock_period() const = 0;

  /// Appends the points of some columns, in the sensor's frame (x forward, z up). Their times are
  /// relative to `begin`, a value of `clock`.
  virtual void append(std::string_view packet, std::size_t first, std::size_t last, Duration begin,
                      LidarScan& scan) const = 0;
};

/// From one reading of a clock to another, at most half a period apart.
inline Duration elapsed(Duration from, Duration to, Duration period) {
  const Duration difference = to - from;
  if (period == Duration::zero()) return difference;
  if (2 * difference < -period) return difference + period;
  return 2 * difference > period ? difference - period : difference;
}

}  // namespace mms
