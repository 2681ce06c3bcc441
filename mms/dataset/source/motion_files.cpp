#include "mms/dataset/source/motion_files.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>

#include "mms/core/error.hpp"
#include "mms/io/motion/motion_io.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

/// A measurement after a frame lets its time be interpolated; most sensors have 50 Hz or more.
constexpr Duration kAfterFrame = std::chrono::milliseconds(20);

constexpr const char* kWheelFiles[] = {"odometry.csv", "odometry.txt"};
constexpr const char* kImuFiles[] = {"imu.csv", "imu.txt", "imu0/data.csv"};

/// How files of the same names begin that have poses of the camera, and rates after accelerations:
/// those of Stray Scanner.
constexpr const char* kOtherContents[] = {"timestamp, frame,", "timestamp, a_x,"};

bool has_other_content(const fs::path& file) {
  constexpr std::size_t kMaxHeader = 100;  // [B]
  std::ifstream stream(file);
  std::string line(kMaxHeader, '\0');
  stream.read(line.data(), static_cast<std::streamsize>(line.size()));
  return std::any_of(std::begin(kOtherContents), std::end(kOtherContents),
                     [&](const char* begin) { return line.starts_with(begin); });
}

fs::path motion_file(const fs::path& given, const fs::path& folder,
                     std::span<const char* const> names) {
  if (given == "none") return {};
  if (!given.empty()) return given;
  for (const char* name : names) {
    const fs::path file = folder / name;
    if (fs::is_regular_file(file) && !has_other_content(file)) return file;
  }
  return {};
}

/// Reads a file, if there is one. One that nobody asked for is left out with a warning if it cannot
/// be read: it may be meant for another program.
template <class Sample>
std::vector<Sample> read_samples(const fs::path& file, bool is_given,
                                 std::vector<Sample> (*read)(const fs::path&),
                                 std::vector<std::string>& warnings) {
  if (file.empty()) return {};
  try {
    return read(file);
  } catch (const DataError& error) {
    if (is_given) throw;
    warnings.push_back(std::string("left out: ") + error.what());
    return {};
  }
}

template <class Sample>
std::string fact_of(const std::vector<Sample>& samples, const std::string& source) {
  std::string text = std::to_string(samples.size()) + " measurements of " + source;
  const double span = to_seconds(samples.back().stamp - samples.front().stamp);
  if (span > 0.0) {
    const double rate = static_cast<double>(samples.size() - 1) / span;
    text += ", " + format_number(std::round(10.0 * rate) / 10.0) + " Hz";
  }
  return text;
}

bool has_constant_rate(const std::vector<ImuSample>& samples) {
  return std::all_of(samples.begin(), samples.end(),
                     [&](const ImuSample& sample) { return sample.rate == samples.front().rate; });
}

template <class Sample>
std::vector<Sample> take_until(const std::vector<Sample>& samples, std::size_t& next,
                               Timestamp end) {
  const std::size_t first = next;
  while (next < samples.size() && samples[next].stamp <= end) ++next;
  return {samples.begin() + static_cast<std::ptrdiff_t>(first),
          samples.begin() + static_cast<std::ptrdiff_t>(next)};
}

}  // namespace

void describe_motion(MotionRecording& recording, const std::string& wheels,
                     const std::string& imu) {
  MotionSamples& samples = recording.samples;
  if (samples.imu.size() > 1 && has_constant_rate(samples.imu)) {
    recording.warnings.push_back(imu +
                                 ": the gyroscope always gives the same rate, so it is left " +
                                 "out: does the sensor have an accelerometer alone?");
    samples.imu.clear();
  }
  if (!samples.wheels.empty()) {
    recording.facts.push_back("wheels: " + fact_of(samples.wheels, wheels));
  }
  if (!samples.imu.empty()) recording.facts.push_back("gyroscope: " + fact_of(samples.imu, imu));
  for (std::string& fault : faults_of({samples.wheels, {}}, wheels)) {
    recording.warnings.push_back(std::move(fault));
  }
  for (std::string& fault : faults_of({{}, samples.imu}, imu)) {
    recording.warnings.push_back(std::move(fault));
  }
}

MotionRecording read_motion_files(const fs::path& folder, const MotionOptions& options) {
  MotionRecording recording;
  const fs::path wheels = motion_file(options.wheels, folder, kWheelFiles);
  const fs::path imu = motion_file(options.imu, folder, kImuFiles);
  recording.samples.wheels =
      read_samples(wheels, !options.wheels.empty(), read_wheels, recording.warnings);
  recording.samples.imu = read_samples(imu, !options.imu.empty(), read_imu, recording.warnings);
  describe_motion(recording, wheels.string(), imu.string());
  return recording;
}

void MotionFeed::add(MotionSamples samples) {
  if (!samples.wheels.empty()) samples_.wheels = std::move(samples.wheels);
  if (!samples.imu.empty()) samples_.imu = std::move(samples.imu);
  wheels_ = imu_ = 0;
}

Timestamp motion_end(const Frame& frame) {
  Timestamp end = frame.stamp;
  if (!frame.scan.time_offset.empty()) {
    const float last =
        *std::max_element(frame.scan.time_offset.begin(), frame.scan.time_offset.end());
    end = end + (Timestamp::from_seconds(std::max(0.0, static_cast<double>(last))) - Timestamp());
  }
  return end + kAfterFrame;
}

void MotionFeed::attach(Frame& frame) {
  if (samples_.empty()) return;
  const Timestamp end = motion_end(frame);
  frame.motion.wheels = take_until(samples_.wheels, wheels_, end);
  frame.motion.imu = take_until(samples_.imu, imu_, end);
}

}  // namespace mms
