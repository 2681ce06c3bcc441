#include "mms/dataset/simulated/objects_truth.hpp"

#include <nlohmann/json.hpp>

namespace mms {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

Json json_of(const PixelBox& box) {
  if (box.empty()) return nullptr;
  return {box.x, box.y, box.width, box.height};
}

Json json_of(const ObjectTruth& object) {
  const Eigen::Quaterniond q(object.T_world_box.linear());
  return {{"id", object.id},
          {"label", 1 + object.id},
          {"class", to_string(object.object_class)},
          {"kind", object.kind},
          {"position", json_of(Eigen::Vector3d(object.T_world_box.translation()))},
          {"quaternion", {q.x(), q.y(), q.z(), q.w()}},
          {"size", json_of(Eigen::Vector3d(2.0 * object.half_extent))},
          {"velocity", json_of(object.velocity)},
          {"moving", object.moving},
          {"visible_box", json_of(object.visible)},
          {"amodal_box", json_of(object.amodal)},
          {"pixels", object.pixels},
          {"occlusion", object.occlusion},
          {"truncation", object.truncation}};
}

}  // namespace

ObjectFrame object_frame(Timestamp stamp, std::span<const ObjectTruth> objects) {
  ObjectFrame frame{stamp, {}};
  for (const ObjectTruth& object : objects) {
    const double share = (1.0 - object.occlusion) * (1.0 - object.truncation);
    frame.objects.push_back({object.id, object.object_class, object.T_world_box,
                             2.0 * object.half_extent, object.velocity, object.moving, 1.0,
                             object.pixels > 0 ? share : 0.0});
  }
  return frame;
}

void ObjectsTruth::add(Timestamp stamp, std::span<const ObjectTruth> objects) {
  frames_ += frames_.empty() ? "\n" : ",\n";
  frames_ += R"({"stamp": ")" + stamp.to_string() + R"(", "objects": [)";
  for (std::size_t i = 0; i < objects.size(); ++i) {
    frames_ += (i == 0 ? "\n " : ",\n ") + json_of(objects[i]).dump();
  }
  frames_ += "]}";
}

std::string ObjectsTruth::json() const {
  return "{\"frames\": [" + frames_ + "\n]}\n";
}

}  // namespace mms
