#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <type_traits>
#include <utility>

#include "interfaces/python/src/bindings.hpp"
#include "interfaces/python/src/live_slam.hpp"
#include "interfaces/python/src/numpy_arrays.hpp"
#include "mms/geometry/depth_registration.hpp"
#include "mms/geometry/parallel.hpp"
#include "mms/io/cloud/pcd_io.hpp"
#include "mms/io/cloud/ply_io.hpp"
#include "mms/io/results/occupancy_grid_io.hpp"
#include "mms/run/results/result_files.hpp"
#include "mms/run/segmenter/network_detector.hpp"
#include "mms/run/sensor_settings.hpp"
#include "mms/segmentation/segmenters/mask_segmenter.hpp"

namespace mms::python {
namespace {

using Path = std::filesystem::path;

std::unique_ptr<Segmenter> make_segmenter_of(const std::string& source,
                                             const SystemConfig& config) {
  if (source == "masks") return std::make_unique<MaskSegmenter>();
  if (source == "network") return make_network_segmenter(config.segmentation);
  if (source == "none") return std::make_unique<NoneSegmenter>();
  throw py::value_error("segmenter: is '" + source + "', allowed: 'masks', 'network', 'none'");
}

/// "key=value" as on the command line.
std::vector<std::string> assignments_of(const py::dict& settings) {
  std::vector<std::string> assignments;
  for (const auto& [key, value] : settings) {
    auto text = py::str(value).cast<std::string>();
    if (py::isinstance<py::bool_>(value)) text = value.cast<bool>() ? "true" : "false";
    assignments.push_back(py::str(key).cast<std::string>() + "=" + text);
  }
  return assignments;
}

/// Where the pixels of an image are; `data` is null for no image.
struct ImageSource {
  const void* data = nullptr;
  int width = 0;
  int height = 0;
  bool is_raw = false;  ///< depth in units of the calibration
};

/// Copies into memory of the same size without allocating anew.
template <class T>
void copy(const ImageSource& from, Image<T>& to) {
  if (to.width() != from.width || to.height() != from.height) to = {from.width, from.height};
  if (from.data != nullptr) std::memcpy(to.pixels().data(), from.data, sizeof(T) * to.size());
}

void copy_depth(const ImageSource& from, double scale, Image<float>& to) {
  if (!from.is_raw) return copy(from, to);
  if (to.width() != from.width || to.height() != from.height) to = {from.width, from.height};
  const auto* raw = static_cast<const std::uint16_t*>(from.data);
  const auto units = static_cast<float>(scale);
  std::transform(raw, raw + to.size(), to.pixels().begin(),
                 [units](std::uint16_t value) { return static_cast<float>(value) / units; });
}

/// Map files, as the arguments name them.
MapFileOptions map_files(const std::optional<Path>& map, const std::optional<Path>& save_map,
                         bool localize, bool overwrite) {
  if (localize && !map) throw py::value_error("localize: needs a map");
  if (localize && save_map)
    throw py::value_error("save_map: is given, but localize changes no map");
  if (save_map && !overwrite && std::filesystem::exists(*save_map)) {
    throw py::value_error("save_map: " + save_map->string() +
                          " exists, allowed: a new file, or overwrite=True");
  }
  return {map.value_or(Path()), save_map.value_or(Path()), localize, overwrite, "Python"};
}

/// A LiveSlam for numpy arrays.
class Slam {
 public:
  Slam(const std::optional<Path>& config, std::shared_ptr<Calibration> calibration,
       const py::dict& settings, const std::string& segmenter, const std::optional<Path>& weights,
       const std::optional<Path>& map, const std::optional<Path>& save_map, bool localize,
       bool overwrite)
      : source_(segmenter) {
    calibration_ = calibration ? std::move(calibration) : std::make_shared<Calibration>();
    if (weights && segmenter != "network") {
      throw py::value_error("weights: is for masks of the network, but they come from " +
                            segmenter);
    }
    std::vector<std::string> warnings;
    SystemConfig system = sensor_settings(calibration_.get(), config.value_or(Path()),
                                          assignments_of(settings), "settings", warnings);
    if (weights) system.segmentation.weights = weights->string();
    warn(warnings);
    const MapFileOptions files = map_files(map, save_map, localize, overwrite);
    // Without a calibration, the first frame brings the largest depth, unless the settings have it.
    bool takes_max_depth = false;
    if (!calibration_->max_depth) {
      Calibration other;
      other.max_depth = 1.0;  // another one than the default
      const SystemConfig with_other = sensor_settings(
          &other, config.value_or(Path()), assignments_of(settings), "settings", warnings);
      takes_max_depth =
          with_other.static_map.surface.max_depth != system.static_map.surface.max_depth;
    }
    const py::gil_scoped_release release;
    slam_ = std::make_unique<LiveSlam>(system, make_segmenter_of(segmenter, system), files,
                                       takes_max_depth);
    registration_ = make_registration(*calibration_);
    calibration_ = registered_calibration(calibration_);
  }

  FrameResult process(const py::array& color, const py::array& depth, std::int64_t stamp,
                      const std::optional<py::array>& masks) {
    if (!calibration_->camera) {
      throw py::value_error("calibration: has no camera, which images need");
    }
    const ImageSource colors = color_source(color);
    const ImageSource depths = depth_source(depth);
    const ImageSource labels = mask_source(masks);
    return fill_and_process(stamp, [&](Frame& frame) {
      // One core alone does not use all of the memory's bandwidth.
      parallel_tasks([&] { copy(colors, frame.color); }, [&] { fill_depth(depths, frame.depth); },
                     [&] { copy(labels, frame.mask); });
      frame.scan = {};
    });
  }

  FrameResult process_scan(const py::array& points, std::int64_t stamp,
                           const std::optional<py::array>& times,
                           const std::optional<py::array>& intensity,
                           const std::optional<py::array>& color,
                           const std::optional<py::array>& masks) {
    LidarScan scan{points_of(points, "points"), numbers_of(intensity, "intensity", points.shape(0)),
                   numbers_of(times, "times", points.shape(0))};
    if ((color || masks) && !calibration_->camera) {
      throw py::value_error("calibration: has no camera, which images need");
    }
    const ImageSource colors = color ? color_source(*color) : ImageSource();
    const ImageSource labels = mask_source(masks);
    return fill_and_process(stamp, [&](Frame& frame) {
      frame.scan = std::move(scan);
      copy(colors, frame.color);
      frame.depth = {};
      copy(labels, frame.mask);
    });
  }

  FrameResult process_frame(const Frame& frame) {
    return with_warnings([&] { return slam_->process(frame); });
  }

  void add_wheels(const Trajectory& odometry) {
    MotionSamples samples;
    for (const StampedPose& pose : odometry) {
      samples.wheels.push_back(
          {pose.stamp, Transform<Odometer, Base>(pose.T_world_sensor.isometry())});
    }
    without_lock([&] { slam_->add_motion(samples); });
  }

  void add_gyroscope(const py::array& given_stamps, const py::array& given_rates,
                     const std::optional<py::array>& given_accelerations) {
    const py::array stamps = packed(given_stamps);
    const py::array rates = packed(given_rates);
    const auto* nanoseconds = data_of<std::int64_t>(stamps, "stamps", "int64", {-1});
    const Shape shape = {stamps.shape(0), 3};
    const auto* rate = data_of<double>(rates, "rates", "float64", shape);
    const std::optional<py::array> accelerations =
        given_accelerations ? std::optional(packed(*given_accelerations)) : std::nullopt;
    const double* acceleration =
        accelerations ? data_of<double>(*accelerations, "accelerations", "float64", shape)
                      : nullptr;
    MotionSamples samples;
    for (py::ssize_t i = 0; i < stamps.shape(0); ++i) {
      ImuSample& sample = samples.imu.emplace_back();
      sample.stamp = Timestamp(nanoseconds[i]);
      sample.rate = Eigen::Vector3d(rate + 3 * i);
      if (acceleration != nullptr) sample.acceleration = Eigen::Vector3d(acceleration + 3 * i);
      if (sample.rate.allFinite() && sample.acceleration.allFinite()) continue;
      throw py::value_error("rates, accelerations: row " + std::to_string(i) + " is not finite");
    }
    without_lock([&] { slam_->add_motion(samples); });
  }

  void expect_place(const Eigen::Matrix4d& pose) {
    const Transform<Global, Sensor> T_global_sensor(isometry_of(pose, "pose"));
    without_lock([&] { slam_->expect_place(T_global_sensor); });
  }

  bool save_map() {
    return with_warnings([this] { return slam_->save_map(); });
  }

  OccupancyGrid occupancy_grid(bool corrected) {
    return with_warnings([&] { return slam_->occupancy_grid(corrected); });
  }

  LiveSlam& live() { return *slam_; }

 private:
  template <class Fill>
  FrameResult fill_and_process(std::int64_t stamp, const Fill& fill) {
    return with_warnings([&] {
      return slam_->fill_and_process([&](Frame& frame) {
        frame.stamp = Timestamp(stamp);
        frame.calibration = calibration_;
        fill(frame);
      });
    });
  }

  /// Without the lock of Python, but for the warnings after it.
  template <class Call>
  std::invoke_result_t<Call> with_warnings(const Call& call) {
    std::vector<std::string> warnings;
    auto result = [&] {
      const py::gil_scoped_release release;
      auto value = call();
      warnings = slam_->take_warnings();  // waits for other threads
      return value;
    }();
    warn(warnings);
    return result;
  }

  ImageSource color_source(const py::array& color) const {
    const CameraIntrinsics& camera = *calibration_->camera;
    const Shape shape = {camera.height, camera.width, 3};
    return {data_of<std::uint8_t>(color, "color", "uint8", shape), camera.width, camera.height};
  }

  ImageSource depth_source(const py::array& depth) const {
    const CameraIntrinsics& camera =
        registration_ ? registration_->depth_camera() : *calibration_->camera;
    const Shape shape = {camera.height, camera.width};
    const bool is_raw = py::isinstance<py::array_t<std::uint16_t>>(depth);
    const void* data =
        is_raw ? static_cast<const void*>(data_of<std::uint16_t>(depth, "depth", "", shape))
               : data_of<float>(depth, "depth",
                                "float32 [m] or uint16 (in units of the calibration)", shape);
    return {data, camera.width, camera.height, is_raw};
  }

  ImageSource mask_source(const std::optional<py::array>& masks) const {
    if (!masks) return {};
    if (source_ != "masks") {
      throw py::value_error("masks: are given, but the masks come from segmenter='" + source_ +
                            "'");
    }
    const CameraIntrinsics& camera = *calibration_->camera;
    const Shape shape = {camera.height, camera.width};
    return {data_of<std::uint8_t>(*masks, "masks", "uint8", shape), camera.width, camera.height};
  }

  /// Depth registered to the color image.
  void fill_depth(const ImageSource& depths, Image<float>& to) {
    if (!registration_) return copy_depth(depths, calibration_->depth_scale, to);
    copy_depth(depths, calibration_->depth_scale, unregistered_);
    to = registration_->apply(unregistered_);
  }

  std::string source_;                              // of the masks
  std::shared_ptr<const Calibration> calibration_;  // of registered depth
  std::optional<DepthRegistration> registration_;
  Image<float> unregistered_;  // of the last frame; used in turns, as the system
  std::unique_ptr<LiveSlam> slam_;
};

void bind_tracked_object(py::module_& module) {
  py::class_<TrackedObject>(module, "TrackedObject", "An object of the dynamic map.")
      .def_readonly("box", &TrackedObject::box, "ObjectBox at the stamp of the frame.")
      .def_property_readonly(
          "seen", [](const TrackedObject& o) { return o.state == TrackState::kActive; },
          "Whether it was seen in the frame; else its motion is predicted.")
      .def_property_readonly(
          "first_seen", [](const TrackedObject& o) { return o.first_seen.nanoseconds(); }, "[ns]")
      .def_property_readonly(
          "last_seen", [](const TrackedObject& o) { return o.last_seen.nanoseconds(); }, "[ns]");
}

void bind_result(py::module_& module) {
  py::class_<FrameResult>(module, "Result", "What a frame gave. Its arrays are views.")
      .def_property_readonly(
          "stamp", [](const FrameResult& r) { return r.odometry.stamp.nanoseconds(); }, "[ns]")
      .def_property_readonly(
          "pose", [](const FrameResult& r) { return matrix_of(r.odometry.T_world_sensor); },
          "4 x 4 float64, sensor to world frame [m]. The world is the sensor frame of the first\n"
          "frame: of a camera x right, y down, z forward; of a LiDAR its own.")
      .def_property_readonly(
          "status", [](const FrameResult& r) { return to_string(r.odometry.status); },
          "'initialized', 'tracking', 'degenerate', 'lost' or 'recovered'.")
      .def_property_readonly(
          "information",
          [](const FrameResult& r) -> Eigen::MatrixXd { return r.odometry.information; },
          "6 x 6 float64: translation [1/m^2], rotation [1/rad^2], in the sensor frame.")
      .def_readonly("keyframe", &FrameResult::keyframe, "Whether it carves the static map.")
      .def_readonly("session", &FrameResult::session,
                    "Number of the session, from 0. After a long loss the next one begins.")
      .def_readonly("relocalized", &FrameResult::relocalized,
                    "Whether the pose is that of a recognized place.")
      .def_property_readonly(
          "world_in_map",
          [](const FrameResult& r) {
            return r.correction.T_global_world
                       ? std::optional(matrix_of(*r.correction.T_global_world))
                       : std::nullopt;
          },
          "4 x 4 float64: pose of the world frame in that of the map, by the loops so far. None "
          "until the place in an earlier map, or of a session after a loss, is recognized.")
      .def_readonly("dynamic_share", &FrameResult::dynamic_share,
                    "Share of the valid points that are dynamic, 0 to 1.")
      // Copies: a box that is kept would keep the points of its frame.
      .def_property_readonly(
          "objects", [](const FrameResult& r) { return r.objects; },
          "List of TrackedObject, by id.")
      .def_readonly("warnings", &FrameResult::warnings, "Lines about wheels and gyroscope.")
      .def_property_readonly(
          "points",
          [](const py::object& r) { return view(r.cast<FrameResult&>().cloud.points, r); },
          "N x 3 float32, sensor frame [m]; NaN without a return.")
      .def_property_readonly(
          "labels",
          [](const py::object& r) { return view(r.cast<FrameResult&>().cloud.labels, r); },
          "N uint8 of the points: 0 no return, 1 static, 2 dynamic.")
      .def_property_readonly(
          "colors",
          [](const py::object& r) { return view(r.cast<FrameResult&>().cloud.colors, r); },
          "N x 3 uint8 of the points; 0 x 3 without a camera.")
      .def_property_readonly(
          "stage_ms",
          [](const FrameResult& r) {
            py::dict times;
            for (std::size_t i = 0; i < kStageCount; ++i) {
              times[py::str(std::string(to_string(static_cast<Stage>(i))))] = r.stage_ms[i];
            }
            return times;
          },
          "Duration of each stage [ms].");
}

void write_cloud(const MapCloud& cloud, const Path& path) {
  const Path extension = path.extension();
  if (extension != ".ply" && extension != ".pcd") {
    throw py::value_error("path: is " + path.string() +
                          ", allowed: a name that ends in .ply or .pcd");
  }
  const PointCloudFile file = file_of(cloud, MapFrame::kCamera);  // without intensities
  if (extension == ".ply") return write_ply(path, file, {"units: m"});
  write_pcd(path, file);
}

void bind_map_cloud(py::module_& module) {
  py::class_<MapCloud>(module, "MapCloud", "The static map as points. Its arrays are views.")
      .def("__len__", &MapCloud::size)
      .def_property_readonly(
          "points", [](const py::object& m) { return view(m.cast<MapCloud&>().points, m); },
          "N x 3 float32, world frame [m].")
      .def_property_readonly(
          "colors", [](const py::object& m) { return view(m.cast<MapCloud&>().colors, m); },
          "N x 3 uint8; gray without a camera.")
      .def_property_readonly(
          "normals", [](const py::object& m) { return view(m.cast<MapCloud&>().normals, m); },
          "N x 3 float32, unit, towards the sensor; zero if unknown.")
      .def_property_readonly(
          "observations",
          [](const py::object& m) { return view(m.cast<MapCloud&>().observations, m); },
          "N int32: number of views that measured the point.")
      .def("write", &write_cloud, py::arg("path"), py::call_guard<py::gil_scoped_release>(),
           "Writes a PLY or PCD file, by its name. Raises FileError.");
}

void write_grid(const OccupancyGrid& grid, const Path& path) {
  if (path.extension() != ".yaml") {
    throw py::value_error("path: is " + path.string() + ", allowed: a name that ends in .yaml");
  }
  write_occupancy_grid(path, grid);
}

void bind_occupancy_grid(py::module_& module) {
  py::class_<OccupancyGrid>(module, "OccupancyGrid",
                            "Top view of the floor, for navigation. Its frame has its origin on\n"
                            "the floor below the first sensor pose, z up, and x forward there.")
      .def_property_readonly(
          "cells", [](const py::object& g) { return view(g.cast<OccupancyGrid&>().cells, g); },
          "rows x columns uint8, a view: 0 unknown, 1 free, 2 occupied. Cell (row, column) is at\n"
          "y = origin[1] + row * resolution and x = origin[0] + column * resolution.")
      .def_readonly("resolution", &OccupancyGrid::resolution, "Side of a cell [m].")
      .def_readonly("origin", &OccupancyGrid::origin,
                    "2: x and y of the corner of cell (0, 0) [m].")
      .def_property_readonly(
          "pose", [](const OccupancyGrid& g) { return matrix_of(g.T_world_map); },
          "4 x 4, frame of the grid to that of trajectory and static map [m].")
      .def("write", &write_grid, py::arg("path"),
           "Writes NAME.yaml and NAME.pgm for map servers of ROS. Raises FileError.");
}

}  // namespace

void bind_slam(py::module_& module) {
  bind_tracked_object(module);
  bind_result(module);
  bind_map_cloud(module);
  bind_occupancy_grid(module);
  const py::call_guard<py::gil_scoped_release> no_gil;
  py::class_<Slam>(
      module, "Slam",
      "Localizes and maps, one frame at a time. Threads may share it: they take turns.\n"
      "Other threads of Python run meanwhile.")
      .def(py::init<const std::optional<Path>&, std::shared_ptr<Calibration>, const py::dict&,
                    const std::string&, const std::optional<Path>&, const std::optional<Path>&,
                    const std::optional<Path>&, bool, bool>(),
           py::arg("config") = py::none(), py::arg("calibration") = py::none(), py::kw_only(),
           py::arg("settings") = py::dict(), py::arg("segmenter") = "masks",
           py::arg("weights") = py::none(), py::arg("map") = py::none(),
           py::arg("save_map") = py::none(), py::arg("localize") = false,
           py::arg("overwrite") = false,
           "config: settings file, as for mms run --config; None: the defaults.\n"
           "calibration: Calibration of the sensor; frames of recordings bring their own.\n"
           "settings: single ones, as {'static_map.voxel_size': 0.05}.\n"
           "segmenter: where masks come from: 'masks' (given ones), 'network' or 'none'.\n"
           "weights: network file in place of the default one.\n"
           "map: file of an earlier map to localize in and to go on mapping.\n"
           "save_map: file that `save_map` writes; None: `map`, if any.\n"
           "localize: leaves `map` as it is. overwrite: replaces a file `save_map`.\n"
           "Raises ValueError, FileError, ConfigError, DataError.")
      .def("process", &Slam::process, py::arg("color"), py::arg("depth"), py::arg("stamp"),
           py::arg("masks") = py::none(),
           "Localizes an image with depth and adds it to the maps.\n"
           "color: height x width x 3 uint8, red green blue.\n"
           "depth: height x width, registered to color: float32 [m], or uint16 in units of the\n"
           "calibration; 0, NaN and inf mean no return. Where the calibration has a depth_camera,\n"
           "it has the size of that one, and is registered here.\n"
           "stamp: int [ns], more than that of the frame before.\n"
           "masks: height x width uint8: 0 static, 1 person, 2 vehicle; None: all is static.\n"
           "Arrays have rows without gaps. Raises ValueError that names argument and value.")
      .def("process_scan", &Slam::process_scan, py::arg("points"), py::arg("stamp"),
           py::arg("times") = py::none(), py::arg("intensity") = py::none(),
           py::arg("color") = py::none(), py::arg("masks") = py::none(),
           "Localizes a LiDAR scan and adds it to the maps.\n"
           "points: N x 3 float32, LiDAR frame [m]; NaN and inf mean no return.\n"
           "stamp: int [ns], more than that of the frame before.\n"
           "times: N float32, of the points after the stamp [s]; None: at once.\n"
           "intensity: N float32, in the sensor's units.\n"
           "color, masks: image of a camera beside it and its masks, as of process.\n"
           "Raises ValueError that names argument and value.")
      .def("process_frame", &Slam::process_frame, py::arg("frame"),
           "Localizes a frame of a recording and adds it to the maps, without a copy.\n"
           "Raises ValueError for a stamp that is not later, DataError for sizes that differ.")
      .def("add_wheels", &Slam::add_wheels, py::arg("odometry"),
           "Adds dead reckoning of wheels, as of nav_msgs/Odometry, for the next calls of process\n"
           "and process_scan. odometry: Trajectory, wheels to odometer frame, later than before.\n"
           "The mounting is in the file of Calibration.read. Raises ValueError.")
      .def("add_gyroscope", &Slam::add_gyroscope, py::arg("stamps"), py::arg("rates"),
           py::arg("accelerations") = py::none(),
           "Adds measurements of a gyroscope for the next calls of process and process_scan.\n"
           "stamps: N int64 [ns], later than before. rates: N x 3 float64 [rad/s].\n"
           "accelerations: N x 3 float64 [m/s^2], or None.\n"
           "The mounting is in the file of Calibration.read. Raises ValueError.")
      .def("expect_place", &Slam::expect_place, py::arg("pose"),
           "Says where the sensor is, for the next call of process or process_scan: its place in\n"
           "the map is searched for around it. Where it seemed known, a session begins anew.\n"
           "pose: 4 x 4, sensor to the frame of the map [m]. Raises ValueError.")
      .def(
          "finish", [](Slam& slam) { slam.live().finish(); }, no_gil,
          "Completes the maps after the last frame.")
      .def("save_map", &Slam::save_map,
           "Writes the map file that was named at the beginning, once, after `finish`.\n"
           "Returns whether there was anything to write. Raises FileError; an earlier map is as\n"
           "before then.")
      .def(
          "trajectory",
          [](Slam& slam, bool corrected) { return slam.live().trajectory(corrected); },
          py::arg("corrected") = false, no_gil,
          "Trajectory of all frames. corrected: by loop closure, in the frame of the map, without "
          "frames whose place in it is unknown.")
      .def(
          "static_map",
          [](Slam& slam, bool corrected) { return slam.live().static_map(corrected); },
          py::arg("corrected") = true, no_gil,
          "MapCloud of what stands still. corrected: by loop closure, with all sessions whose\n"
          "place is known, as result files are. Else of the present session.")
      .def("occupancy_grid", &Slam::occupancy_grid, py::arg("corrected") = true,
           "OccupancyGrid of the floor, as map.yaml of mms run. corrected: as of static_map.\n"
           "Raises RuntimeError where the setting occupancy.enabled is off.")
      .def(
          "objects", [](Slam& slam) { return slam.live().objects(); }, no_gil,
          "List of TrackedObject of the last frame, by id.");
}

}  // namespace mms::python
