#include "mms/io/motion/motion_io.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "mms/core/error.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/numbers.hpp"
#include "mms/io/text/pose_text.hpp"
#include "mms/io/text/stamp_reader.hpp"
#include "mms/io/text/text_table.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

/// Longest time between two measurements that is no gap [s].
constexpr double kMaxInterval = 0.5;

/// Rate [rad/s] that 1 % of the measurements of a sane sensor do not exceed: 570 degrees/s.
constexpr double kMaxCommonRate = 10.0;

/// The numbers of a line after its stamp.
struct StampedNumbers {
  Timestamp stamp;
  std::vector<double> values;
  std::string where;
};

constexpr const char* kWheelColumns = "stamp x y z qx qy qz qw, or stamp x y yaw";
constexpr const char* kImuColumns = "stamp wx wy wz, or stamp wx wy wz ax ay az";

/// @param columns  allowed numbers of columns
std::vector<StampedNumbers> read_stamped(const fs::path& path, std::array<std::size_t, 2> columns,
                                         const char* form) {
  const TextTable table(path);
  const StampReader read_stamp(table, 0, kLongestMotionStep);
  std::vector<StampedNumbers> lines;
  for (const TextLine& line : table.lines()) {
    const std::string where = table.where(line);
    const std::size_t count = line.fields.size();
    if (count != columns[0] && count != columns[1]) {
      throw DataError(where, std::to_string(count) + " columns, expected " + form,
                      "a header begins with #");
    }
    const auto stamp = read_stamp(line.fields[0]);
    if (!stamp) {
      throw DataError(where, "'" + std::string(line.fields[0]) + "' is not a stamp",
                      "stamps are seconds, or nanoseconds since 1970; a header begins with #");
    }
    if (!lines.empty() && *stamp < lines.back().stamp) {
      throw DataError(where,
                      "stamp " + stamp->to_string() + " is before the previous one, " +
                          lines.back().stamp.to_string(),
                      "sort the lines by stamp");
    }
    if (!lines.empty() && *stamp == lines.back().stamp) continue;
    lines.push_back({*stamp, parse_finite(std::span(line.fields).subspan(1), where), where});
  }
  if (lines.empty()) throw DataError(path.string(), "has no measurements", form);
  return lines;
}

Eigen::Isometry3d wheel_pose(const StampedNumbers& line) {
  const std::vector<double>& n = line.values;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (n.size() == 3) {
    pose.linear() = Eigen::AngleAxisd(n[2], Eigen::Vector3d::UnitZ()).toRotationMatrix();
    pose.translation() = Eigen::Vector3d(n[0], n[1], 0.0);
    return pose;
  }
  constexpr double kMinNorm = 1e-6;
  const Eigen::Quaterniond rotation(n[6], n[3], n[4], n[5]);
  if (rotation.norm() < kMinNorm) throw DataError(line.where, "the quaternion is zero");
  pose.linear() = rotation.normalized().toRotationMatrix();
  pose.translation() = Eigen::Vector3d(n[0], n[1], n[2]);
  return pose;
}

void append_line(std::string& text, Timestamp stamp, std::span<const double> numbers) {
  text += stamp.to_string();
  for (const double number : numbers) text.append(",").append(format_number(number));
  text.append("\n");
}

template <class Sample>
void add_gaps(const std::vector<Sample>& samples, const std::string& what,
              std::vector<std::string>& faults) {
  std::size_t gaps = 0;
  double longest = 0.0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double interval = to_seconds(samples[i].stamp - samples[i - 1].stamp);
    if (interval > kMaxInterval) ++gaps;
    longest = std::max(longest, interval);
  }
  if (gaps == 0) return;
  faults.push_back(what + " have " + std::to_string(gaps) +
                   " gaps of more than 0.5 s, the longest " +
                   format_number(std::round(100.0 * longest) / 100.0) + " s");
}

}  // namespace

std::vector<WheelSample> read_wheels(const fs::path& path) {
  std::vector<WheelSample> samples;
  for (const StampedNumbers& line : read_stamped(path, {8, 4}, kWheelColumns)) {
    samples.push_back({line.stamp, Transform<Odometer, Base>(wheel_pose(line))});
  }
  return samples;
}

std::vector<ImuSample> read_imu(const fs::path& path) {
  std::vector<ImuSample> samples;
  for (const StampedNumbers& line : read_stamped(path, {7, 4}, kImuColumns)) {
    const std::vector<double>& n = line.values;
    ImuSample& sample = samples.emplace_back();
    sample.stamp = line.stamp;
    sample.rate = Eigen::Vector3d(n[0], n[1], n[2]);
    if (n.size() == 6) sample.acceleration = Eigen::Vector3d(n[3], n[4], n[5]);
  }
  return samples;
}

void write_wheels(const fs::path& path, std::span<const WheelSample> samples) {
  std::string text = "# stamp [s],x [m],y,z,qx,qy,qz,qw\n";
  for (const WheelSample& sample : samples) {
    const Eigen::Vector3d t = sample.T_odom_base.translation();
    const Eigen::Quaterniond q(sample.T_odom_base.rotation());
    append_line(text, sample.stamp, std::array{t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()});
  }
  write_file(path, text);
}

void write_imu(const fs::path& path, std::span<const ImuSample> samples) {
  std::string text = "# stamp [s],wx [rad/s],wy,wz,ax [m/s^2],ay,az\n";
  for (const ImuSample& sample : samples) {
    const Eigen::Vector3d& w = sample.rate;
    const Eigen::Vector3d& a = sample.acceleration;
    append_line(text, sample.stamp, std::array{w.x(), w.y(), w.z(), a.x(), a.y(), a.z()});
  }
  write_file(path, text);
}

std::vector<std::string> faults_of(const MotionSamples& samples, const std::string& where) {
  std::vector<std::string> faults;
  add_gaps(samples.wheels, where + ": wheels", faults);
  add_gaps(samples.imu, where + ": rates of the gyroscope", faults);
  std::vector<double> rates;
  for (const ImuSample& sample : samples.imu) rates.push_back(sample.rate.norm());
  if (rates.empty()) return faults;
  const auto common =
      rates.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(rates.size() - 1));
  std::nth_element(rates.begin(), common, rates.end());
  if (*common > kMaxCommonRate) {
    faults.push_back(where + ": the gyroscope turns by " + format_number(std::round(*common)) +
                     " rad/s: are its rates in degrees per second? They must be in rad/s");
  }
  return faults;
}

}  // namespace mms
