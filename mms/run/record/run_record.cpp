#include "mms/run/record/run_record.hpp"

#include <fmt/core.h>
#include <fmt/format.h>
#include <array>

#include <iterator>
#include <nlohmann/json.hpp>

#include "mms/core/error.hpp"
#include "mms/evaluation/trajectory/stamp_matching.hpp"
#include "mms/evaluation/trajectory/trajectory_error.hpp"
#include "mms/evaluation/trajectory/truth_frame.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/text/numbers.hpp"
#include "mms/io/text/text_table.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view kFramesHeader =
    "stamp,index,status,dynamic_share,overruled_share,implausible_masks,session,in_map";

struct TopicField {
  const char* key;
  std::string BagTopicNames::*name;
};

/// Keys of the topics in run.json.
constexpr std::array<TopicField, 8> kTopicFields{{{"color", &BagTopicNames::color},
                                                  {"depth", &BagTopicNames::depth},
                                                  {"cloud", &BagTopicNames::cloud},
                                                  {"camera_info", &BagTopicNames::camera_info},
                                                  {"mask", &BagTopicNames::mask},
                                                  {"wheels", &BagTopicNames::wheels},
                                                  {"imu", &BagTopicNames::imu},
                                                  {"truth", &BagTopicNames::truth}}};

Json json_of(const std::optional<CameraIntrinsics>& camera) {
  if (!camera) return nullptr;
  return {{"width", camera->width}, {"height", camera->height}, {"fx", camera->fx},
          {"fy", camera->fy},       {"cx", camera->cx},         {"cy", camera->cy}};
}

std::optional<CameraIntrinsics> camera_of(const Json& json) {
  if (json.is_null()) return std::nullopt;
  CameraIntrinsics camera;
  json.at("width").get_to(camera.width);
  json.at("height").get_to(camera.height);
  json.at("fx").get_to(camera.fx);
  json.at("fy").get_to(camera.fy);
  json.at("cx").get_to(camera.cx);
  json.at("cy").get_to(camera.cy);
  return camera;
}

CameraOptions with_absolute_path(CameraOptions options) {
  if (!options.file.empty()) options.file = absolute_path(options.file);
  return options;
}

/// null if nothing was given.
Json json_of(const CameraOptions& given) {
  if (given.empty()) return nullptr;
  return {{"file", given.file.string()},
          {"intrinsics", given.intrinsics ? Json(*given.intrinsics) : Json(nullptr)},
          {"depth_scale", given.depth_scale ? Json(*given.depth_scale) : Json(nullptr)}};
}

/// The given ones alone.
Json json_of(const BagTopicNames& topics) {
  Json json = Json::object();
  for (const TopicField& field : kTopicFields) {
    if (!(topics.*field.name).empty()) json[field.key] = topics.*field.name;
  }
  return json;
}

/// Runs of earlier versions, and those of other recordings than bags, have none.
BagTopicNames topics_of(const Json& run) {
  BagTopicNames topics;
  if (!run.contains("topics")) return topics;
  for (const TopicField& field : kTopicFields) {
    topics.*field.name = run["topics"].value(field.key, "");
  }
  return topics;
}

/// Runs of earlier versions have none.
std::optional<double> rate_of(const Json& run) {
  if (!run.contains("rate") || run["rate"].is_null()) return std::nullopt;
  return run["rate"].get<double>();
}

/// Runs of earlier versions have none.
CameraOptions camera_options_of(const Json& run) {
  CameraOptions given;
  if (!run.contains("calibration") || run["calibration"].is_null()) return given;
  const Json& json = run["calibration"];
  given.file = json.at("file").get<std::string>();
  if (!json.at("intrinsics").is_null()) {
    given.intrinsics = json["intrinsics"].get<std::array<double, 4>>();
  }
  if (!json.at("depth_scale").is_null()) given.depth_scale = json["depth_scale"].get<double>();
  return given;
}

std::string frames_csv(const RunLog& log) {
  std::string text = std::string(kFramesHeader) + "\n";
  for (const LoggedFrame& frame : log.frames()) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{:.5f},{:.5f},{},{},{:d}\n",
                   frame.stamp.to_string(), frame.index, to_string(frame.status),
                   frame.dynamic_share, frame.overruled_share, frame.implausible_masks,
                   frame.session, frame.in_map);
  }
  return text;
}

std::optional<Status> status_of(std::string_view name) {
  for (int i = 0; i < kStatusCount; ++i) {
    if (name == to_string(static_cast<Status>(i))) return static_cast<Status>(i);
  }
  return std::nullopt;
}

std::optional<FrameRecord> frame_of(const TextLine& line) {
  // Runs of earlier versions end with the dynamic share, the implausible masks or the session.
  const std::size_t columns = line.fields.size();
  if (columns != 4 && (columns < 6 || columns > 8)) return std::nullopt;
  const auto stamp = parse_stamp(line.fields[0]);
  const auto index = parse_integer(line.fields[1]);
  const auto status = status_of(line.fields[2]);
  const auto share = parse_double(line.fields[3]);
  if (!stamp || !index || !status || !share || *index < 0) return std::nullopt;
  FrameRecord frame = {*stamp, *index, *status, *share, std::nullopt};
  if (columns >= 6) {
    frame.overruled_share = parse_double(line.fields[4]);
    if (!frame.overruled_share || !parse_integer(line.fields[5])) return std::nullopt;
  }
  for (std::size_t i = 6; i < columns; ++i) {
    if (!parse_integer(line.fields[i])) return std::nullopt;
  }
  return frame;
}

}  // namespace

std::string absolute_path(const fs::path& path) {
  std::error_code error;
  const fs::path found = fs::absolute(path, error);
  return error ? path.string() : found.lexically_normal().string();
}

RunRecord record_of(const RunOptions& options, const std::optional<CameraIntrinsics>& camera,
                    bool depth_camera, double voxel_size) {
  const bool address = options.data.starts_with("sim:") || options.data.starts_with("camera:");
  return {address ? options.data : absolute_path(options.data),
          options.segmenter,
          options.masks.empty() ? "" : absolute_path(options.masks),
          options.topics,
          with_absolute_path(options.camera),
          options.rate,
          depth_camera,
          voxel_size,
          camera};
}

void write_run_record(const fs::path& folder, const RunRecord& record, const RunLog& log) {
  Json json = {{"data", record.data},
               {"segmenter", record.segmenter},
               {"masks", record.masks},
               {"calibration", json_of(record.given)},
               {"rate", record.rate ? Json(*record.rate) : Json(nullptr)},
               {"sensor", record.depth_camera ? "depth camera" : "lidar"},
               {"voxel_size", record.voxel_size},
               {"camera", json_of(record.camera)}};
  if (!record.topics.empty()) json["topics"] = json_of(record.topics);
  write_file(folder / "run.json", json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  write_file(folder / "frames.csv", frames_csv(log));
  const Trajectory truth = aligned_truth(log.truth(), log.corrected_trajectory());
  if (!truth.empty()) write_trajectory_tum(folder / "truth.tum", truth);
}

RunRecord read_run_record(const fs::path& file) {
  try {
    const Json json = Json::parse(read_file(file));
    return {json.at("data").get<std::string>(),
            json.at("segmenter").get<std::string>(),
            json.at("masks").get<std::string>(),
            topics_of(json),
            camera_options_of(json),
            rate_of(json),
            json.at("sensor").get<std::string>() == "depth camera",
            json.at("voxel_size").get<double>(),
            camera_of(json.at("camera"))};
  } catch (const Json::exception& error) {
    throw DataError(file.string(), std::string("is not a record of a run: ") + error.what());
  }
}

std::vector<FrameRecord> read_frame_records(const fs::path& file) {
  const TextTable table(file);
  std::vector<FrameRecord> frames;
  for (const TextLine& line : table.lines()) {
    if (line.fields[0] == "stamp") continue;
    const std::optional<FrameRecord> frame = frame_of(line);
    if (!frame) {
      throw DataError(table.where(line), "is not a row of \"" + std::string(kFramesHeader) + "\"");
    }
    frames.push_back(*frame);
  }
  return frames;
}

Trajectory aligned_truth(const Trajectory& truth, const Trajectory& estimate) {
  const auto T = align_truth(truth, estimate);
  if (!T) return {};
  Trajectory aligned;
  for (const PoseMatch& match :
       match_by_stamp(truth, estimate, TrajectoryErrorOptions{}.max_difference)) {
    const Eigen::Isometry3d pose = *T * truth[match.reference].T_world_sensor.isometry();
    aligned.push_back({estimate[match.estimate].stamp, Transform<World, Sensor>(pose)});
  }
  return aligned;
}

}  // namespace mms
