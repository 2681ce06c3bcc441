#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <sstream>

#include "interfaces/python/src/bindings.hpp"
#include "interfaces/python/src/numpy_arrays.hpp"
#include "mms/core/calibration.hpp"
#include "mms/core/frame.hpp"
#include "mms/core/object_box.hpp"
#include "mms/io/config/calibration_formats.hpp"
#include "mms/io/config/calibration_ranges.hpp"
#include "mms/io/results/objects_io.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "mms/io/text/atomic_file.hpp"

namespace mms::python {
namespace {

using std::int64_t;

// The fields of an entry of a trajectory repeat with its size.
static_assert(sizeof(Timestamp) == sizeof(int64_t));

/// A field of all poses, without a copy.
py::array field_view(const py::object& owner, const void* first, const py::dtype& type, Shape shape,
                     Shape strides) {
  const auto& trajectory = owner.cast<const Trajectory&>();
  shape.insert(shape.begin(), static_cast<py::ssize_t>(trajectory.size()));
  strides.insert(strides.begin(), sizeof(StampedPose));
  return py::array(type, shape, strides, first, owner);
}

py::array stamps_of(const py::object& self) {
  const auto& trajectory = self.cast<const Trajectory&>();
  static const StampedPose kNone;
  const StampedPose& first = trajectory.empty() ? kNone : trajectory.front();
  return field_view(self, &first.stamp, py::dtype::of<int64_t>(), {}, {});
}

py::array poses_of(const py::object& self) {
  const auto& trajectory = self.cast<const Trajectory&>();
  static const StampedPose kNone;
  const StampedPose& first = trajectory.empty() ? kNone : trajectory.front();
  // Eigen's matrices are column by column.
  return field_view(self, first.T_world_sensor.isometry().data(), py::dtype::of<double>(), {4, 4},
                    {sizeof(double), 4 * sizeof(double)});
}

Trajectory make_trajectory(const py::array& given_stamps, const py::array& given_poses) {
  const py::array stamps = packed(given_stamps);
  const py::array poses = packed(given_poses);
  const auto* nanoseconds = data_of<int64_t>(stamps, "stamps", "int64", {-1});
  const auto* numbers = data_of<double>(poses, "poses", "float64", {stamps.shape(0), 4, 4});
  Trajectory trajectory;
  for (py::ssize_t i = 0; i < stamps.shape(0); ++i) {
    using Rows = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
    const Eigen::Matrix4d matrix = Eigen::Map<const Rows>(numbers + 16 * i);
    trajectory.push_back(
        {Timestamp(nanoseconds[i]), Transform<World, Sensor>(isometry_of(matrix, "poses"))});
  }
  return trajectory;
}

CameraIntrinsics make_camera(double fx, double fy, double cx, double cy, int width, int height,
                             const std::array<double, 5>& distortion) {
  const CameraIntrinsics camera{fx, fy, cx, cy, width, height, distortion};
  check_camera(camera, "Camera");
  return camera;
}

void check_number(double value, const char* name, const Range& range, const char* unit) {
  if (value >= range.min && value <= range.max) return;
  std::ostringstream text;
  text << name << ": is " << value << ", allowed: " << range.min << " to " << range.max << unit;
  throw py::value_error(text.str());
}

std::shared_ptr<Calibration> make_calibration(const std::optional<CameraIntrinsics>& camera,
                                              double depth_scale, std::optional<double> max_depth,
                                              const Eigen::Matrix4d& T_camera_lidar,
                                              const std::optional<CameraIntrinsics>& depth_camera,
                                              const Eigen::Matrix4d& T_color_depth) {
  check_number(depth_scale, "depth_scale", kDepthScaleRange, " (depth image units per meter)");
  if (max_depth) check_number(*max_depth, "max_depth", kMaxDepthRange, " m");
  if (depth_camera && !camera) throw py::value_error("depth_camera: needs a camera");
  auto calibration = std::make_shared<Calibration>();
  calibration->camera = camera;
  calibration->depth_scale = depth_scale;
  calibration->max_depth = max_depth;
  calibration->T_camera_lidar =
      Transform<Camera, Lidar>(isometry_of(T_camera_lidar, "T_camera_lidar"));
  if (depth_camera) {
    calibration->depth_camera = DepthCamera{
        *depth_camera, Transform<Camera, Depth>(isometry_of(T_color_depth, "T_color_depth"))};
  }
  return calibration;
}

void bind_calibration(py::module_& module) {
  py::class_<CameraIntrinsics>(module, "Camera",
                               "Pinhole camera with the distortion k1 k2 p1 p2 k3 of OpenCV.")
      .def(py::init(&make_camera), py::arg("fx"), py::arg("fy"), py::arg("cx"), py::arg("cy"),
           py::arg("width"), py::arg("height"), py::arg("distortion") = std::array<double, 5>{},
           "Focal lengths, principal point and size [px]; pixel centers are whole numbers.\n"
           "Raises ConfigError for numbers that no camera has.")
      .def_readonly("fx", &CameraIntrinsics::fx, "Focal length [px].")
      .def_readonly("fy", &CameraIntrinsics::fy, "Focal length [px].")
      .def_readonly("cx", &CameraIntrinsics::cx, "Principal point [px].")
      .def_readonly("cy", &CameraIntrinsics::cy, "Principal point [px].")
      .def_readonly("width", &CameraIntrinsics::width, "[px]")
      .def_readonly("height", &CameraIntrinsics::height, "[px]")
      .def_readonly("distortion", &CameraIntrinsics::distortion, "k1 k2 p1 p2 k3; zeros: none.");
  py::class_<Calibration, std::shared_ptr<Calibration>>(module, "Calibration",
                                                        "Calibration of a sensor.")
      .def(py::init(&make_calibration), py::arg("camera") = py::none(),
           py::arg("depth_scale") = 1000.0, py::arg("max_depth") = py::none(),
           py::arg_v("T_camera_lidar", Eigen::Matrix4d(Eigen::Matrix4d::Identity()), "identity"),
           py::arg("depth_camera") = py::none(),
           py::arg_v("T_color_depth", Eigen::Matrix4d(Eigen::Matrix4d::Identity()), "identity"),
           "camera: Camera, or None for a LiDAR alone.\n"
           "depth_scale: units of 16-bit depth images per meter.\n"
           "max_depth: largest depth used for mapping [m].\n"
           "T_camera_lidar: 4 x 4, LiDAR to camera frame [m], for images with scans.\n"
           "depth_camera: Camera of depth images that are not registered to color.\n"
           "T_color_depth: 4 x 4, frame of depth_camera to that of camera [m].\n"
           "Raises ValueError for numbers out of range.")
      .def_static(
          "read",
          [](const std::filesystem::path& path) {
            return std::make_shared<Calibration>(read_any_calibration(path).calibration);
          },
          py::arg("path"),
          "Reads a calibration file: ours, or of ROS, OpenCV, Kalibr, EuRoC, OpenLORIS, ORB-SLAM.\n"
          "Raises FileError, ConfigError, DataError.")
      .def_readonly("camera", &Calibration::camera, "Camera, or None.")
      .def_readonly("depth_scale", &Calibration::depth_scale, "Depth image units per meter.")
      .def_readonly("max_depth", &Calibration::max_depth, "Largest depth used for mapping [m].")
      .def_property_readonly(
          "T_camera_lidar", [](const Calibration& c) { return matrix_of(c.T_camera_lidar); },
          "4 x 4, LiDAR to camera frame [m].")
      .def_property_readonly(
          "depth_camera",
          [](const Calibration& c) {
            return c.depth_camera ? std::optional(c.depth_camera->camera) : std::nullopt;
          },
          "Camera of depth images that are not registered to color, or None.")
      .def_property_readonly(
          "T_color_depth",
          [](const Calibration& c) {
            return matrix_of(c.depth_camera ? c.depth_camera->T_color_depth
                                            : Transform<Camera, Depth>());
          },
          "4 x 4, frame of depth_camera to that of camera [m].");
}

void bind_frame(py::module_& module) {
  py::class_<Frame>(module, "Frame",
                    "Sensor data of one instant. Its arrays are views of the library's memory.")
      .def_readonly("index", &Frame::index, "In the recording, with skipped frames.")
      .def_property_readonly(
          "stamp", [](const Frame& f) { return f.stamp.nanoseconds(); },
          "Nanoseconds since the epoch of the recording's clock.")
      .def_readonly("name", &Frame::name, "File name without folder, for messages.")
      .def_property_readonly(
          "color", [](const py::object& f) { return view(f.cast<Frame&>().color, f); },
          "height x width x 3 uint8, red green blue; 0 x 0 x 3 without a camera.")
      .def_property_readonly(
          "depth", [](const py::object& f) { return view(f.cast<Frame&>().depth, f); },
          "height x width float32 [m], registered to color; 0, NaN and inf: no return.")
      .def_property_readonly(
          "masks", [](const py::object& f) { return view(f.cast<Frame&>().mask, f); },
          "height x width uint8: 0 static, 1 person, 2 vehicle; 0 x 0 without masks.")
      .def_property_readonly(
          "points", [](const py::object& f) { return view(f.cast<Frame&>().scan.points, f); },
          "N x 3 float32, LiDAR frame [m]; 0 x 3 without a LiDAR.")
      .def_property_readonly(
          "times", [](const py::object& f) { return view(f.cast<Frame&>().scan.time_offset, f); },
          "N float32: times of the points after the stamp [s]; empty if unknown.")
      .def_property_readonly(
          "intensity", [](const py::object& f) { return view(f.cast<Frame&>().scan.intensity, f); },
          "N float32 in the sensor's units; empty if unknown.")
      .def_property_readonly(
          "calibration",
          [](const Frame& f) { return std::const_pointer_cast<Calibration>(f.calibration); },
          "Calibration of this frame.");
}

void bind_trajectory(py::module_& module) {
  const py::call_guard<py::gil_scoped_release> no_gil;
  py::class_<Trajectory>(module, "Trajectory", "Poses of a sensor over time.")
      .def(py::init(&make_trajectory), py::arg("stamps"), py::arg("poses"),
           "stamps: N int64 [ns]. poses: N x 4 x 4 float64, sensor to world frame [m].\n"
           "Raises ValueError for other types and shapes, and what is no rigid transform.")
      .def("__len__", [](const Trajectory& t) { return t.size(); })
      .def_property_readonly("stamps", &stamps_of, "N int64 [ns], a view.")
      .def_property_readonly("poses", &poses_of,
                             "N x 4 x 4 float64, sensor to world frame [m], a view.")
      .def_static("read", &read_trajectory, py::arg("path"), no_gil,
                  "Reads a file of TUM or KITTI. Raises FileError, DataError.")
      .def(
          "write",
          [](const Trajectory& trajectory, const std::filesystem::path& path) {
            write_trajectory_tum(path, trajectory);
          },
          py::arg("path"), no_gil, "Writes a TUM file, without loss. Raises FileError.");
}

void bind_objects(py::module_& module) {
  py::class_<ObjectBox>(module, "ObjectBox", "An object at one instant: a box in the world frame.")
      .def_readonly("id", &ObjectBox::id, "The same in all frames.")
      .def_property_readonly(
          "object_class", [](const ObjectBox& box) { return to_string(box.object_class); },
          "'person', 'agv' (any vehicle), or 'unknown': it moves, and has no mask.")
      .def_property_readonly(
          "pose", [](const ObjectBox& box) -> Eigen::Matrix4d { return box.T_world_box.matrix(); },
          "4 x 4, box to world frame [m]; the box has x forward, z up, its center as origin.")
      .def_property_readonly("center", &ObjectBox::center, "3, world frame [m].")
      .def_readonly("size", &ObjectBox::size, "3: length, width, height [m].")
      .def_readonly("velocity", &ObjectBox::velocity, "3, world frame [m/s].")
      .def_readonly("moving", &ObjectBox::moving, "Whether it moves now.")
      .def_readonly("score", &ObjectBox::score, "Confidence in the class, 0 to 1.");
  py::class_<ObjectFrame>(module, "ObjectFrame", "The objects at one instant.")
      .def(py::init([](int64_t stamp, std::vector<ObjectBox> boxes) {
             return ObjectFrame{Timestamp(stamp), std::move(boxes)};
           }),
           py::arg("stamp"), py::arg("objects"), "stamp: [ns]. objects: list of ObjectBox.")
      .def_property_readonly(
          "stamp", [](const ObjectFrame& f) { return f.stamp.nanoseconds(); }, "[ns]")
      .def_readonly("objects", &ObjectFrame::objects, "List of ObjectBox, by id.");
  const py::call_guard<py::gil_scoped_release> no_gil;
  module.def("read_objects", &read_objects, py::arg("path"), no_gil,
             "Objects of a run (objects.json), a list of ObjectFrame.\n"
             "Raises FileError, DataError.");
  module.def(
      "write_objects",
      [](const std::filesystem::path& path, const ObjectHistory& objects) {
        write_file(path, objects_json(objects));
      },
      py::arg("path"), py::arg("objects"), no_gil,
      "Writes objects as objects.json of a run, which has no frames without any.\n"
      "objects: list of ObjectFrame, by stamp. Raises FileError.");
}

}  // namespace

void bind_types(py::module_& module) {
  bind_calibration(module);
  bind_frame(module);
  bind_trajectory(module);
  bind_objects(module);
}

}  // namespace mms::python
