#include "mms/io/results/objects_io.hpp"

#include <array>
#include <map>

#include "mms/io/config/json_entry.hpp"

namespace mms {
namespace {

using Json = nlohmann::ordered_json;

constexpr Range kId = {0, 2147483647.0};
constexpr Range kShare = {0.0, 1.0};
constexpr Range kUnit = {-1.0 - 1e-6, 1.0 + 1e-6};

Json json_of(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

Json json_of(Timestamp stamp, const ObjectBox& object) {
  const Eigen::Quaterniond q(object.T_world_box.linear());
  return {{"stamp", stamp.to_string()},
          {"position", json_of(Eigen::Vector3d(object.center()))},
          {"quaternion", {q.x(), q.y(), q.z(), q.w()}},
          {"size", json_of(object.size)},
          {"velocity", json_of(object.velocity)},
          {"moving", object.moving},
          {"score", object.score}};
}

template <std::size_t n>
std::array<double, n> read_numbers(const JsonEntry& list, Range range = {}) {
  const std::vector<JsonEntry> elements = list.elements();
  if (elements.size() != n) list.fail("is not a list of " + std::to_string(n) + " numbers");
  std::array<double, n> values{};
  for (std::size_t i = 0; i < n; ++i) values[i] = elements[i].number(range);
  return values;
}

Eigen::Vector3d read_vector(const JsonEntry& list, Range range = {}) {
  const auto [x, y, z] = read_numbers<3>(list, range);
  return {x, y, z};
}

Timestamp read_stamp(const JsonEntry& entry) {
  const auto stamp = Timestamp::parse(entry.text());
  if (!stamp) entry.fail("is '" + entry.text() + "', expected seconds as in \"12.500000000\"");
  return *stamp;
}

ObjectClass read_class(const JsonEntry& entry) {
  const std::string name = entry.text();
  for (int i = 0; i < kTrackedClassCount; ++i) {
    if (name == to_string(static_cast<ObjectClass>(i))) return static_cast<ObjectClass>(i);
  }
  entry.fail("is '" + name + "', allowed: person, agv, unknown");
}

/// Reads the keys that both files share.
ObjectBox read_box(const JsonEntry& entry) {
  const auto [x, y, z, w] = read_numbers<4>(entry.at("quaternion"), kUnit);
  const Eigen::Quaterniond rotation(w, x, y, z);
  if (rotation.norm() < 0.5) entry.at("quaternion").fail("is not a rotation: norm below 0.5");
  ObjectBox object;
  object.T_world_box = Eigen::Translation3d(read_vector(entry.at("position"))) *
                       rotation.normalized() * Eigen::Isometry3d::Identity();
  object.size = read_vector(entry.at("size"), {0.0});
  object.velocity = read_vector(entry.at("velocity"));
  return object;
}

}  // namespace

std::string objects_json(const ObjectHistory& history) {
  std::map<int, std::vector<std::pair<Timestamp, const ObjectBox*>>> tracks;
  for (const ObjectFrame& frame : history) {
    for (const ObjectBox& object : frame.objects)
      tracks[object.id].emplace_back(frame.stamp, &object);
  }
  std::string text = "{\"tracks\": [";
  std::string_view comma;
  for (const auto& [id, track] : tracks) {
    text.append(comma).append("\n{\"id\": ").append(std::to_string(id));
    text.append(", \"class\": \"").append(to_string(track.back().second->object_class));
    text.append("\", \"history\": [");
    std::string_view inner;
    for (const auto& [stamp, object] : track) {
      text.append(inner).append("\n ").append(json_of(stamp, *object).dump());
      inner = ",";
    }
    text.append("]}");
    comma = ",";
  }
  return text + "\n]}\n";
}

ObjectHistory read_objects(const std::filesystem::path& path) {
  const nlohmann::json json = parse_json(path);
  std::map<Timestamp, ObjectFrame> frames;
  for (const JsonEntry& track : JsonEntry(json, path.string()).at("tracks").elements()) {
    const auto id = static_cast<int>(track.at("id").integer(kId));
    const ObjectClass object_class = read_class(track.at("class"));
    for (const JsonEntry& seen : track.at("history").elements()) {
      ObjectBox object = read_box(seen);
      object.id = id;
      object.object_class = object_class;
      object.moving = seen.at("moving").boolean();
      object.score = seen.at("score").number(kShare);
      const Timestamp stamp = read_stamp(seen.at("stamp"));
      ObjectFrame& frame = frames[stamp];
      frame.stamp = stamp;
      frame.objects.push_back(object);
    }
  }
  ObjectHistory history;
  for (auto& [stamp, frame] : frames) history.push_back(std::move(frame));
  return history;
}

ObjectHistory read_objects_truth(const std::filesystem::path& path) {
  const nlohmann::json json = parse_json(path);
  ObjectHistory history;
  for (const JsonEntry& entry : JsonEntry(json, path.string()).at("frames").elements()) {
    ObjectFrame& frame = history.emplace_back();
    frame.stamp = read_stamp(entry.at("stamp"));
    for (const JsonEntry& item : entry.at("objects").elements()) {
      ObjectBox object = read_box(item);
      object.id = static_cast<int>(item.at("id").integer(kId));
      object.object_class = read_class(item.at("class"));
      object.moving = item.at("moving").boolean();
      object.visible = item.at("pixels").integer({0.0}) == 0
                           ? 0.0
                           : (1.0 - item.at("occlusion").number(kShare)) *
                                 (1.0 - item.at("truncation").number(kShare));
      frame.objects.push_back(object);
    }
  }
  return history;
}

}  // namespace mms
