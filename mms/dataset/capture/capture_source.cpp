#include "mms/dataset/capture/capture_source.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/dataset/capture/capture_sensor.hpp"
#include "mms/dataset/source/calibration_choice.hpp"
#include "mms/dataset/source/recorded_source.hpp"
#include "mms/io/results/trajectory_io.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

/// A rotation in the capture.
struct Rotation {
  std::int64_t position = 0;  // of its first packet
  std::size_t column = 0;     // of that packet
  std::size_t columns = 0;
  Duration clock{};  // of the sensor at the first column
  Timestamp stamp;
};

/// Stamps by the sensor's clock, which has no jitter. It is set to the computer's at the beginning
/// unless it counts from 1970, and where they differ.
class CaptureClock {
 public:
  Timestamp stamp(Duration clock, Timestamp captured, Duration period) {
    constexpr Duration kMaxClockDifference = std::chrono::milliseconds(500);
    if (!begun_) {
      constexpr Duration kYear2001 = std::chrono::hours(24 * 365 * 31);  // since 1970
      stamp_ = clock > kYear2001 ? Timestamp() + clock : captured;
      offset_ = stamp_ - captured;
      begun_ = true;
    } else {
      stamp_ = stamp_ + elapsed(clock_, clock, period);
      const Timestamp expected = captured + offset_;
      if (std::chrono::abs(stamp_ - expected) > kMaxClockDifference) stamp_ = expected;
    }
    clock_ = clock;
    return stamp_;
  }

 private:
  bool begun_ = false;
  Timestamp stamp_;
  Duration clock_{};
  Duration offset_{};
};

/// A capture may begin and end within a rotation.
void drop_partial_ends(std::vector<Rotation>& rotations) {
  constexpr double kWholeShare = 0.95;
  const auto is_partial = [](const Rotation& rotation, const Rotation& next) {
    return static_cast<double>(rotation.columns) < kWholeShare * static_cast<double>(next.columns);
  };
  if (rotations.size() > 1 && is_partial(rotations[0], rotations[1])) {
    rotations.erase(rotations.begin());
  }
  if (rotations.size() > 1 && is_partial(rotations.back(), rotations[rotations.size() - 2])) {
    rotations.pop_back();
  }
}

/// The rotations from the present position of the capture on.
std::vector<Rotation> find_rotations(PacketCapture& capture, const CaptureSensor& sensor) {
  std::vector<Rotation> rotations;
  PacketDecoder& decoder = *sensor.decoder;
  CaptureClock clocks;
  std::int64_t position = capture.position();
  while (const auto datagram = capture.next()) {
    const std::int64_t begin = position;
    position = capture.position();
    if (!sensor.sent(*datagram)) continue;
    const std::string_view packet = datagram->payload;
    const Duration clock = decoder.clock(packet, 0);
    const Timestamp stamp = clocks.stamp(clock, datagram->captured, decoder.clock_period());
    const auto start = decoder.rotation_start(packet);
    if (rotations.empty()) rotations.push_back({begin, 0, 0, clock, stamp});
    rotations.back().columns += start.value_or(decoder.columns());
    if (!start) continue;
    const Duration start_clock = decoder.clock(packet, *start);
    rotations.push_back({begin, *start, decoder.columns() - *start, start_clock,
                         stamp + elapsed(clock, start_clock, decoder.clock_period())});
  }
  drop_partial_ends(rotations);
  return rotations;
}

class CaptureSource final : public RecordedSource {
 public:
  explicit CaptureSource(const fs::path& path)
      : path_(path.string()), capture_(std::make_unique<PacketCapture>(path)) {
    const std::int64_t begin = capture_->position();
    sensor_ = find_capture_sensor(*capture_, path);
    capture_->seek(begin);
    rotations_ = find_rotations(*capture_, sensor_);
    if (capture_->damaged()) warn(path_ + ": is damaged or truncated, the rest is not read");
    fs::path truth = path;
    truth.replace_extension(".groundtruth.txt");
    if (!fs::exists(truth)) return;
    set_ground_truth(read_trajectory_tum(truth));
    sensor_.facts.push_back("poses: " + truth.filename().string());
  }

  std::size_t size() const override { return rotations_.size(); }

 protected:
  Timestamp stamp_at(std::size_t index) const override { return rotations_[index].stamp; }
  std::string name_at(std::size_t index) const override {
    char name[24];
    std::snprintf(name, sizeof name, "%06zu", index);
    return name;
  }
  std::vector<std::string> facts() const override {
    std::vector<std::string> lines = {"layout: capture of LiDAR packets (UDP port " +
                                      std::to_string(sensor_.port) + ")"};
    lines.insert(lines.end(), sensor_.facts.begin(), sensor_.facts.end());
    return lines;
  }

  Frame read(std::size_t index) const override {
    const Rotation& rotation = rotations_[index];
    Frame frame;
    frame.calibration = calibration_;
    capture_->seek(rotation.position);
    std::size_t first = rotation.column;
    std::size_t left = rotation.columns;
    while (left > 0) {
      const auto datagram = capture_->next();
      if (!datagram) break;
      if (!sensor_.sent(*datagram)) continue;
      const std::size_t last = std::min(sensor_.decoder->columns(), first + left);
      sensor_.decoder->append(datagram->payload, first, last, rotation.clock, frame.scan);
      left -= last - first;
      first = 0;
    }
    if (frame.scan.points.empty()) throw DataError(path_, "the rotation has no points");
    return frame;
  }

 private:
  std::string path_;
  std::unique_ptr<PacketCapture> capture_;
  CaptureSensor sensor_;
  std::vector<Rotation> rotations_;
  std::shared_ptr<const Calibration> calibration_ = std::make_shared<const Calibration>();
};

}  // namespace

std::unique_ptr<FrameSource> open_capture(const fs::path& path, const SourceOptions& options) {
  if (!options.camera.empty()) {
    throw DataError(path.string(), "is a capture of a LiDAR and needs no camera",
                    "omit --calibration, --intrinsics and --depth-scale");
  }
  return std::make_unique<CaptureSource>(path);
}

}  // namespace mms
