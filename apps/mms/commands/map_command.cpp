#include "apps/mms/commands/map_command.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/mms/commands/commands.hpp"
#include "apps/mms/console/common_options.hpp"
#include "apps/mms/console/overwrite_option.hpp"
#include "apps/mms/console/rate_progress.hpp"
#include "apps/mms/console/warnings.hpp"
#include "mms/core/error.hpp"
#include "mms/global_map/corrected_occupancy.hpp"
#include "mms/io/cloud/pcd_io.hpp"
#include "mms/io/cloud/ply_io.hpp"
#include "mms/io/config/config_yaml.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "mms/map_file/map_composition.hpp"
#include "mms/map_file/map_merge.hpp"
#include "mms/map_file/session_changes.hpp"
#include "mms/pipeline/system_config.hpp"
#include "mms/run/results/result_files.hpp"
#include "mms/run/results/robot_maps.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;

void warn(const std::string& message) {
  print_warnings({message});
}

constexpr Rgb kGreen = {30, 190, 60};
constexpr Rgb kRed = {230, 30, 30};
constexpr Rgb kGrey = {160, 160, 160};

/// What changed between sessions, by color; what no other session looked at keeps its own.
MapCloud picture_of(const MapChangeCloud& changes) {
  MapCloud picture = points_of(changes, {Change::kUnknown});
  const auto add = [&](Change change, Rgb color) {
    MapCloud points = points_of(changes, {change});
    std::fill(points.colors.begin(), points.colors.end(), color);
    append(picture, points);
  };
  add(Change::kUnchanged, kGrey);
  add(Change::kNew, kGreen);
  add(Change::kGone, kRed);
  return picture;
}

/// Settings of the first session; the defaults where this version cannot read them.
SystemConfig settings_of(const MapFile& file, const fs::path& path) {
  SystemConfig config;
  if (file.sessions().empty()) return config;
  try {
    parse_config(file.sessions().front().settings, path.string() + ", its settings", config);
  } catch (const ConfigError& error) {
    warn(std::string(error.what()) + "; the default settings are used");
  }
  return config;
}

void export_map(const fs::path& path, const fs::path& folder, bool overwrite) {
  const MapFile file(path, MapFile::Mode::kRead);
  const GlobalMapContent content = file.content(warn);
  const SystemConfig config = settings_of(file, path);
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  if (!fs::is_directory(folder, ignored)) {
    throw FileError(folder.string(), "cannot create folder", "choose another one with -o");
  }
  const auto check = [&](const std::string& name) {
    refuse_existing_file(folder / name, overwrite);
    return folder / name;
  };
  const fs::path ply = check("static_map.ply");
  const fs::path pcd = check("static_map.pcd");
  for (const char* name : {"map.yaml", "map.pgm", "map.bt"}) check(name);
  const std::vector<std::uint32_t> joined = joined_sessions(content);
  const fs::path picture = check("changes.ply");
  const auto name_of = [](std::uint32_t session) { return fmt::format("session_{}.tum", session); };
  for (const std::uint32_t session : joined) check(name_of(session));
  if (overwrite) {  // what this map may not have
    fs::remove(picture, ignored);
    constexpr std::uint32_t kMaxSessions = 1000;
    for (std::uint32_t i = 0; i < kMaxSessions; ++i) fs::remove(folder / name_of(i), ignored);
  }
  for (const std::uint32_t session : joined) {
    write_trajectory_tum(folder / name_of(session), session_trajectory(content, session));
  }
  const MapFrame frame =
      has_scans(content, 0).value_or(false) ? MapFrame::kLidar : MapFrame::kCamera;
  MapCloud map;
  MapCloud gone;
  if (joined.size() == 1) {
    map = composed_map(file, content, warn);
  } else {
    const MapChangeCloud changes = find_changes(file, content, config.noise.depth, warn);
    map = points_of(changes, {Change::kUnchanged, Change::kNew, Change::kUnknown});
    write_ply(picture, file_of(picture_of(changes), frame), ply_comments(frame));
    gone = points_of(changes, {Change::kGone});
    fmt::print("{}: {} new, {} gone\n", picture.string(), points_of(changes, {Change::kNew}).size(),
               gone.size());
  }
  write_ply(ply, file_of(map, frame), ply_comments(frame));
  write_pcd(pcd, file_of(map, frame));
  const auto is_joined = [&](std::uint32_t session) {
    return std::find(joined.begin(), joined.end(), session) != joined.end();
  };
  const OccupancyMap occupancy =
      corrected_occupancy(content.records, content.poses, is_joined, config.occupancy,
                          with_noise(config.static_map.surface, config.noise));
  write_robot_maps(folder, occupancy, map, frame == MapFrame::kCamera, MapMarking::kObstacles,
                   gone.points);
  fmt::print("{}: {} points of {} sessions\n", ply.string(), map.size(), joined.size());
  if (joined.size() == file.sessions().size()) return;
  warn(fmt::format("{} sessions are left out, since no loop joins them to the first one",
                   file.sessions().size() - joined.size()));
}

void check_map(const fs::path& path) {
  const MapFile file(path, MapFile::Mode::kRead);
  const std::vector<std::string> faults = file.check();
  for (const std::string& fault : faults) fmt::print("{}\n", fault);
  if (!faults.empty()) {
    throw DataError(path.string(), fmt::format("has {} faults", faults.size()),
                    "mms map export writes what can be read");
  }
  fmt::print("{}: no faults in {} sessions, {} keyframes\n", path.string(), file.sessions().size(),
             file.keyframes());
}

void compact(const fs::path& path) {
  const auto before = fs::exists(path) ? fs::file_size(path) : 0;
  compact_map_file(path);
  constexpr double kMegabyte = 1e6;
  fmt::print("{}: {:.1f} MB, {:.1f} MB before\n", path.string(),
             static_cast<double>(fs::file_size(path)) / kMegabyte,
             static_cast<double>(before) / kMegabyte);
}

void merge(const std::vector<std::string>& maps, const fs::path& output, bool overwrite) {
  refuse_existing_file(output, overwrite);
  MapMerge merge({maps.begin(), maps.end()}, warn);
  const SystemConfig config = settings_of(merge.first(), merge.first_path());
  GlobalMap map(config.global_map, with_noise(config.features, config.noise),
                config.odometry.registration);
  RateProgress progress("keyframe");
  const std::size_t joined = merge.join(map, [&](std::size_t done, std::size_t all) {
    progress.show(static_cast<int>(done), static_cast<int>(all));
  });
  progress.finish();
  merge.write(output, map, warn);
  fmt::print("{}: {} of {} sessions joined, {} keyframes\n", output.string(), joined,
             merge.sessions(), map.records().size());
  if (joined == merge.sessions()) return;
  warn(
      fmt::format("{} sessions share no recognized place with the first one; they stay in the file",
                  merge.sessions() - joined));
}

}  // namespace

void print_map_info(const std::string& path, bool json) {
  const MapFile file(path, MapFile::Mode::kRead);
  const GlobalMapContent content = file.content(warn);
  const std::vector<std::uint32_t> joined = joined_sessions(content);
  if (!json) {
    fmt::print("map file: {} sessions, {} keyframes, {} loops\n", file.sessions().size(),
               file.keyframes(), file.loops());
  }
  nlohmann::ordered_json sessions = nlohmann::ordered_json::array();
  for (std::uint32_t i = 0; i < file.sessions().size(); ++i) {
    const MapSession& session = file.sessions()[i];
    const auto keyframes =
        std::count_if(content.records.begin(), content.records.end(),
                      [&](const KeyframeRecord& record) { return record.session == i; });
    const bool is_joined = std::find(joined.begin(), joined.end(), i) != joined.end();
    const double seconds = to_seconds(session.end - session.begin);
    const bool is_lidar = has_scans(content, i).value_or(false);
    if (json) {
      sessions.push_back({{"session", i},
                          {"name", session.name},
                          {"program", session.program},
                          {"frames", session.frames},
                          {"seconds", seconds},
                          {"keyframes", keyframes},
                          {"points", file.points(i)},
                          {"voxel_size_m", session.voxel_size},
                          {"joined", is_joined},
                          {"sensor", is_lidar ? "lidar" : "camera"}});
      if (is_lidar) continue;
      sessions.back()["camera"] = {
          {"width", session.camera.width}, {"height", session.camera.height},
          {"fx", session.camera.fx},       {"fy", session.camera.fy},
          {"cx", session.camera.cx},       {"cy", session.camera.cy}};
      continue;
    }
    fmt::print("session {}: {}, {} frames, {:.1f} s, {} keyframes, {} points of {:.3f} m{}\n", i,
               session.name, session.frames, seconds, keyframes, file.points(i), session.voxel_size,
               is_joined ? "" : ", not joined to session 0");
    if (is_lidar) {
      fmt::print("  LiDAR, made by mms {}\n", session.program);
      continue;
    }
    fmt::print("  camera: {}x{}, fx {:.1f}, made by mms {}\n", session.camera.width,
               session.camera.height, session.camera.fx, session.program);
  }
  if (!json) return;
  const nlohmann::ordered_json map = {{"map", path},
                                      {"keyframes", file.keyframes()},
                                      {"loops", file.loops()},
                                      {"sessions", sessions}};
  fmt::print("{}\n", map.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void add_merge_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("merge", "Join maps of several runs or robots at the places they share");
  const auto maps = std::make_shared<std::vector<std::string>>();
  const auto output = std::make_shared<std::string>();
  const auto overwrite = std::make_shared<bool>(false);
  command->add_option("MAP", *maps, "maps of mms run --save-map; their order does not matter")
      ->required()
      ->expected(2, -1);
  command->add_option("-o,--output", *output, "the joined map")->required();
  add_overwrite_flag(*command, *overwrite);
  command->callback([=] { merge(*maps, *output, *overwrite); });
}

void add_map_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("map", "Export, check or compact a map file");
  command->require_subcommand(1);
  const auto path = std::make_shared<std::string>();
  const auto add = [&](const char* name, const char* description) {
    CLI::App* added = command->add_subcommand(name, description);
    added->add_option("FILE", *path, "map of mms run --save-map")->required();
    return added;
  };
  CLI::App* exported = add(
      "export",
      "Write the static map, the occupancy maps and the poses of the keyframes of all sessions");
  const auto folder = std::make_shared<std::string>();
  const auto overwrite = std::make_shared<bool>(false);
  exported->add_option("-o,--output", *folder, "folder for the files")->required();
  exported->add_flag("--overwrite", *overwrite, "replace files of an earlier export");
  exported->callback([=] { export_map(*path, *folder, *overwrite); });
  add("check", "Read everything in the file and list all faults")->callback([=] {
    check_map(*path);
  });
  add("compact", "Write the file anew without unused space")->callback([=] { compact(*path); });
}

}  // namespace mms
