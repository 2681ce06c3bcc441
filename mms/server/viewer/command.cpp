#include "mms/server/viewer/command.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "mms/core/error.hpp"

namespace mms {
namespace {

using Json = nlohmann::json;

constexpr double kMaxCount = 1e9;

[[noreturn]] void fail(const std::string& what) {
  throw DataError("message", what);
}

const Json& member(const Json& json, const char* name) {
  const auto found = json.find(name);
  if (found == json.end()) fail(std::string("has no \"") + name + "\"");
  return *found;
}

double number(const Json& value, const char* name, double min, double max) {
  if (value.is_number()) {
    const auto given = value.get<double>();
    if (given >= min && given <= max) return given;
  }
  fail(std::string("\"") + name + "\" must be a number from " + Json(min).dump() + " to " +
       Json(max).dump());
}

std::size_t count(const Json& value, const char* name) {
  return static_cast<std::size_t>(number(value, name, 0.0, kMaxCount));
}

std::optional<bool> flag(const Json& json, const char* name) {
  const auto found = json.find(name);
  if (found == json.end()) return std::nullopt;
  if (!found->is_boolean()) fail(std::string("\"") + name + "\" must be true or false");
  return found->get<bool>();
}

WantCommand want_of(const Json& json) {
  WantCommand want{flag(json, "points"), flag(json, "image"), flag(json, "map"), std::nullopt};
  if (json.contains("budget")) want.budget = count(json["budget"], "budget");
  return want;
}

FocusCommand focus_of(const Json& json) {
  constexpr double kMaxCoordinate = 1e6;  // [m]
  const Json& point = member(json, "point");
  if (!point.is_array() || point.size() != 3) fail("\"point\" must be [x, y, z]");
  FocusCommand focus;
  for (int axis = 0; axis < 3; ++axis) {
    const double value =
        number(point[static_cast<std::size_t>(axis)], "point", -kMaxCoordinate, kMaxCoordinate);
    focus.point[axis] = static_cast<float>(value);
  }
  return focus;
}

StepCommand step_of(const Json& json) {
  if (!json.contains("by")) return {};
  return {static_cast<int>(number(json["by"], "by", -kMaxCount, kMaxCount))};
}

}  // namespace

Command parse_command(std::string_view text) {
  if (text.size() > kMaxCommandBytes) fail("is longer than 4096 bytes");
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) fail("is not a JSON object");
  const Json& type = member(json, "type");
  if (type == "play") return PlayCommand{};
  if (type == "pause") return PauseCommand{};
  if (type == "step") return step_of(json);
  if (type == "seek") return SeekCommand{count(member(json, "frame"), "frame")};
  if (type == "speed") {
    return SpeedCommand{number(member(json, "value"), "value", kMinSpeed, kMaxSpeed)};
  }
  if (type == "want") return want_of(json);
  if (type == "focus") return focus_of(json);
  fail("its \"type\" is unknown; known: play, pause, step, seek, speed, want, focus");
}

}  // namespace mms
