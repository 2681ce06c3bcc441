#include "mms/server/viewer/viewer_messages.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace mms {
namespace {

using Json = nlohmann::json;

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

Json json_of(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

Json json_of(const std::optional<CameraIntrinsics>& camera) {
  if (!camera) return nullptr;
  return {{"width", camera->width}, {"height", camera->height}, {"fx", camera->fx},
          {"fy", camera->fy},       {"cx", camera->cx},         {"cy", camera->cy}};
}

Json json_of(const ObjectBox& object) {
  const Eigen::Quaterniond q(object.T_world_box.linear());
  return {{"id", object.id},
          {"class", to_string(object.object_class)},
          {"center", json_of(object.center())},
          {"q", {q.x(), q.y(), q.z(), q.w()}},
          {"size", json_of(object.size)},
          {"velocity", json_of(object.velocity)},
          {"moving", object.moving},
          {"seen", object.visible > 0.0},
          {"score", object.score}};
}

void append_pose(std::vector<float>& values, const Transform<World, Sensor>& T_world_sensor) {
  const Eigen::Vector3f t = T_world_sensor.translation().cast<float>();
  const Eigen::Quaternionf q(T_world_sensor.rotation().cast<float>());
  values.insert(values.end(), {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()});
}

void append_truth(std::vector<float>& values, const std::optional<Eigen::Vector3d>& truth) {
  for (int axis = 0; axis < 3; ++axis) {
    values.push_back(truth ? static_cast<float>((*truth)[axis]) : kUnknown);
  }
}

std::uint32_t milliseconds(Duration duration) {
  return static_cast<std::uint32_t>(std::max<std::int64_t>(
      0, std::chrono::duration_cast<std::chrono::milliseconds>(duration).count()));
}

std::span<const std::uint8_t> bytes_of(const std::vector<Rgb>& colors) {
  static_assert(sizeof(Rgb) == 3);
  return {reinterpret_cast<const std::uint8_t*>(colors.data()), colors.size() * sizeof(Rgb)};
}

std::span<const float> floats_of(const std::vector<Eigen::Vector3f>& points) {
  static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
  return {reinterpret_cast<const float*>(points.data()), points.size() * 3};
}

Json named_series(const SceneInfo& info, const SceneFrame& frame) {
  Json values = Json::object();
  for (std::size_t i = 0; i < info.series.size() && i < frame.series.size(); ++i) {
    const float value = frame.series[i];
    values[info.series[i].name] = std::isfinite(value) ? Json(value) : Json(nullptr);
  }
  return values;
}

std::string_view to_string(PicturesState state) {
  return state == PicturesState::kHere      ? "here"
         : state == PicturesState::kPending ? "pending"
                                            : "none";
}

void add_pictures(MessageWriter& writer, const EncodedPictures& pictures,
                  const PictureParts& parts) {
  if (parts.points && !pictures.points.points.empty()) {
    writer.add("points", floats_of(pictures.points.points), 3);
    writer.add("colors", bytes_of(pictures.points.colors), 3);
    writer.add("dynamic", pictures.dynamic, 1);
  }
  if (!parts.image) return;
  if (!pictures.jpeg.empty()) writer.add("image", pictures.jpeg, 1);
  if (!pictures.mask_png.empty()) writer.add("mask", pictures.mask_png, 1);
}

}  // namespace

Message hello_message(const SceneInfo& info, const std::vector<std::string>& files,
                      std::string_view version) {
  Json classes = Json::array();
  for (int i = 0; i < kTrackedClassCount; ++i) {
    classes.push_back(to_string(static_cast<ObjectClass>(i)));
  }
  return MessageWriter({{"type", "hello"},
                        {"protocol", kProtocolVersion},
                        {"version", version},
                        {"name", info.name},
                        {"data", info.data},
                        {"run", info.id},
                        {"live", info.live},
                        {"image", json_of(info.camera)},
                        {"frames", info.frames ? Json(*info.frames) : Json(nullptr)},
                        {"has_truth", info.has_truth},
                        {"has_pictures", info.has_pictures},
                        {"pictures_note", info.pictures_note},
                        {"voxel", info.voxel_size},
                        {"classes", classes},
                        {"up", json_of(info.up)},
                        {"files", files}})
      .finish();
}

Message trajectory_message(const Scene& scene, std::size_t first, std::size_t last) {
  std::vector<float> poses;
  std::vector<std::uint32_t> stamps;
  std::vector<float> truth;
  const Timestamp start = scene.frame(0).stamp;
  scene.for_each_frame(first, last, [&](const SceneFrame& frame) {
    append_pose(poses, frame.T_world_sensor);
    stamps.push_back(milliseconds(frame.stamp - start));
    append_truth(truth, frame.truth);
  });
  MessageWriter writer({{"type", "trajectory"}, {"first_frame", first}});
  writer.add("pose", poses, 7);
  writer.add("stamp", stamps, 1);
  if (scene.info().has_truth) writer.add("truth", truth, 3);
  return writer.finish();
}

Message series_message(const Scene& scene, std::size_t first, std::size_t last) {
  const std::vector<SeriesName>& series = scene.info().series;
  Json names = Json::array();
  Json units = Json::array();
  for (const SeriesName& name : series) {
    names.push_back(name.name);
    units.push_back(name.unit);
  }
  std::vector<float> values;
  scene.for_each_frame(first, last, [&](const SceneFrame& frame) {
    for (std::size_t i = 0; i < series.size(); ++i) {
      values.push_back(i < frame.series.size() ? frame.series[i] : kUnknown);
    }
  });
  MessageWriter writer(
      {{"type", "series"}, {"first_frame", first}, {"names", names}, {"units", units}});
  if (!series.empty()) writer.add("values", values, static_cast<int>(series.size()));
  return writer.finish();
}

Message tracks_message(const Scene& scene, std::size_t first, std::size_t last) {
  std::map<int, std::uint32_t> places;
  Json ids = Json::array();
  Json classes = Json::array();
  std::vector<std::uint32_t> tracks;
  std::vector<std::uint32_t> numbers;
  std::vector<float> centers;
  auto number = static_cast<std::uint32_t>(first);
  scene.for_each_frame(first, last, [&](const SceneFrame& frame) {
    for (const ObjectBox& object : frame.objects) {
      const auto [place, added] =
          places.try_emplace(object.id, static_cast<std::uint32_t>(places.size()));
      if (added) {
        ids.push_back(object.id);
        classes.push_back(static_cast<int>(object.object_class));
      }
      tracks.push_back(place->second);
      numbers.push_back(number);
      const Eigen::Vector3f center = object.center().cast<float>();
      centers.insert(centers.end(), {center.x(), center.y(), center.z()});
    }
    ++number;
  });
  MessageWriter writer({{"type", "tracks"}, {"ids", ids}, {"classes", classes}});
  writer.add("track", tracks, 1);
  writer.add("frame", numbers, 1);
  writer.add("center", centers, 3);
  return writer.finish();
}

Message loops_message(const std::vector<SceneLoop>& loops) {
  std::vector<std::string> outcomes;
  std::vector<std::uint32_t> frames;
  std::vector<std::uint8_t> accepted;
  std::vector<std::uint8_t> outcome;
  for (const SceneLoop& loop : loops) {
    const auto known = std::find(outcomes.begin(), outcomes.end(), loop.outcome);
    outcome.push_back(static_cast<std::uint8_t>(known - outcomes.begin()));
    if (known == outcomes.end()) outcomes.push_back(loop.outcome);
    frames.push_back(static_cast<std::uint32_t>(loop.earlier));
    frames.push_back(static_cast<std::uint32_t>(loop.later));
    accepted.push_back(loop.is_accepted ? 1 : 0);
  }
  MessageWriter writer({{"type", "loops"}, {"outcomes", outcomes}});
  writer.add("frames", frames, 2);
  writer.add("accepted", accepted, 1);
  writer.add("outcome", outcome, 1);
  return writer.finish();
}

Message frame_message(const SceneInfo& info, const SceneFrame& frame, std::size_t index,
                      PicturesState state, const EncodedPictures* pictures,
                      const PictureParts& parts) {
  Json objects = Json::array();
  for (const ObjectBox& object : frame.objects) objects.push_back(json_of(object));
  MessageWriter writer({{"type", "frame"},
                        {"frame", index},
                        {"stamp_ns", std::to_string(frame.stamp.nanoseconds())},
                        {"status", mms::to_string(frame.status)},
                        {"lost", frame.status == Status::kLost},
                        {"pictures", to_string(state)},
                        {"series", named_series(info, frame)},
                        {"objects", objects}});
  std::vector<float> pose;
  append_pose(pose, frame.T_world_sensor);
  writer.add("pose", pose, 7);
  if (frame.truth) {
    std::vector<float> truth;
    append_truth(truth, frame.truth);
    writer.add("truth", truth, 3);
  }
  if (pictures != nullptr) add_pictures(writer, *pictures, parts);
  return writer.finish();
}

Message map_message(const VoxelKey& chunk, const LevelPoints& points) {
  const bool gone = points.cloud.points.empty();
  MessageWriter writer({{"type", "map"},
                        {"chunk", std::to_string(chunk.x) + "," + std::to_string(chunk.y) + "," +
                                      std::to_string(chunk.z)},
                        {"level", points.level},
                        {"voxel", points.voxel_size},
                        {"remove", gone}});
  if (!gone) {
    writer.add("points", floats_of(points.cloud.points), 3);
    writer.add("colors", bytes_of(points.cloud.colors), 3);
  }
  return writer.finish();
}

Message state_message(const PlayState& state, const std::vector<std::string>& files) {
  Json json = {{"type", "state"},      {"playing", state.playing}, {"frame", state.frame},
               {"speed", state.speed}, {"ended", state.ended},     {"dropped", state.dropped}};
  if (!files.empty()) json["files"] = files;
  return MessageWriter(std::move(json)).finish();
}

Message error_message(std::string_view text) {
  return MessageWriter({{"type", "error"}, {"message", text}}).finish();
}

}  // namespace mms
