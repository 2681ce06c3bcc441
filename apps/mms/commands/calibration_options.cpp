#include "apps/mms/commands/calibration_options.hpp"

#include <algorithm>
#include <string>
#include <string_view>

#include "mms/io/config/calibration_ranges.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace {

constexpr const char* kGroup = "Calibration (default: the recording's)";

/// False for NaN.
bool is_in(double value, const Range& range) {
  return value >= range.min && value <= range.max;
}

/// Reads "fx,fy,cx,cy".
std::array<double, 4> parse_intrinsics(const std::string& text) {
  std::array<double, 4> numbers{};
  std::string_view rest = text;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::size_t end = i + 1 < numbers.size() ? rest.find(',') : rest.size();
    const auto number = parse_double(rest.substr(0, end));
    const Range& range = i < 2 ? kFocalRange : kPrincipalPointRange;
    if (end == std::string_view::npos || !number || !is_in(*number, range)) {
      throw CLI::ValidationError("--intrinsics", text + " is not fx,fy,cx,cy in pixels");
    }
    numbers[i] = *number;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return numbers;
}

/// CLI11's own check of a range accepts NaN.
double parse_depth_scale(const std::string& text) {
  const auto scale = parse_double(text);
  if (scale && is_in(*scale, kDepthScaleRange)) return *scale;
  throw CLI::ValidationError("--depth-scale", text + " is not a number from 0.001 to 1e6");
}

/// [Hz]; the stamps of a year of images fit in 64 bits
constexpr Range kRateRange{0.2, 1000.0};

double parse_rate(const std::string& text) {
  const auto rate = parse_double(text);
  if (rate && is_in(*rate, kRateRange)) return *rate;
  throw CLI::ValidationError("--rate", text + " is not a number from 0.2 to 1000");
}

}  // namespace

CLI::Option* add_depth_scale_option(CLI::App& command, std::optional<double>& scale) {
  return command
      .add_option_function<std::string>(
          "--depth-scale", [&scale](const std::string& text) { scale = parse_depth_scale(text); },
          "depth image units per meter")
      ->type_name("FLOAT");
}

void add_calibration_options(CLI::App& command, CameraOptions& options) {
  command
      .add_option("--calibration", options.file,
                  "calibration file to use, of any format of mms calibration convert")
      ->check(CLI::ExistingFile)
      ->group(kGroup);
  command
      .add_option_function<std::string>(
          "--intrinsics",
          [&options](const std::string& text) { options.intrinsics = parse_intrinsics(text); },
          "camera without distortion [px]")
      ->type_name("fx,fy,cx,cy")
      ->group(kGroup);
  add_depth_scale_option(command, options.depth_scale)->group(kGroup);
}

void add_rate_option(CLI::App& command, std::optional<double>& rate) {
  command
      .add_option_function<std::string>(
          "--rate", [&rate](const std::string& text) { rate = parse_rate(text); },
          "frames a second, if the recording has no time stamps (default: 15, for known data sets "
          "30, for a LiDAR 10)")
      ->type_name("HZ");
}

}  // namespace mms
