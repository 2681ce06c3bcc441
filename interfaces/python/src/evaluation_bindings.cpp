#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <map>

#include "interfaces/python/src/bindings.hpp"
#include "interfaces/python/src/numpy_arrays.hpp"
#include "mms/core/error.hpp"
#include "mms/evaluation/map/map_error.hpp"
#include "mms/evaluation/segmentation/segmentation_error.hpp"
#include "mms/evaluation/tracking/tracking_error.hpp"
#include "mms/evaluation/trajectory/drift.hpp"
#include "mms/evaluation/trajectory/trajectory_error.hpp"
#include "mms/evaluation/trajectory/truth_frame.hpp"
#include "mms/io/image/coco_io.hpp"

namespace mms::python {
namespace {

/// Keys and values of the JSON that mms eval prints.
py::dict dict_of(const std::vector<MetricValue>& values) {
  py::dict result;
  for (const MetricValue& value : values) {
    const bool is_count = value.decimals == 0;
    if (is_count) {
      result[py::str(value.key)] = static_cast<std::int64_t>(value.value);
    } else {
      result[py::str(value.key)] = value.value;
    }
  }
  return result;
}

py::dict trajectory_error(const Trajectory& reference, const Trajectory& estimate,
                          double max_difference, bool align, std::optional<double> rpe_delta,
                          const std::string& rpe_unit) {
  static const std::map<std::string, DeltaUnit> kUnits = {
      {"s", DeltaUnit::kSeconds}, {"m", DeltaUnit::kMeters}, {"frames", DeltaUnit::kFrames}};
  if (!kUnits.contains(rpe_unit)) {
    throw py::value_error("rpe_unit: is '" + rpe_unit + "', allowed: 's', 'm', 'frames'");
  }
  TrajectoryErrorOptions options;
  options.align = align;
  options.max_difference =
      std::chrono::round<Duration>(std::chrono::duration<double>(max_difference));
  if (rpe_delta) options.rpe_delta = {*rpe_delta, kUnits.at(rpe_unit)};
  return dict_of(metric_values(
      without_lock([&] { return evaluate_trajectory(reference, estimate, options); })));
}

py::dict map_error(const py::array& truth_static, const py::array& truth_dynamic,
                   const py::array& map, double radius) {
  const std::vector<Eigen::Vector3f> static_points = points_of(truth_static, "truth_static");
  const std::vector<Eigen::Vector3f> dynamic_points = points_of(truth_dynamic, "truth_dynamic");
  const std::vector<Eigen::Vector3f> map_points = points_of(map, "map");
  return dict_of(metric_values(without_lock(
      [&] { return evaluate_map(static_points, dynamic_points, map_points, radius); })));
}

Eigen::Matrix4d truth_transform(const Trajectory& truth, const Trajectory& estimate) {
  const auto T = align_truth(truth, estimate);
  if (!T) throw DataError("estimate", "has no pose within 0.02 s of a ground-truth pose");
  return T->matrix();
}

py::dict object_error(const ObjectHistory& truth, const ObjectHistory& tracks,
                      const Trajectory& truth_poses, const Trajectory& estimate) {
  return dict_of(metric_values(without_lock([&] {
    const Eigen::Isometry3d T(truth_transform(truth_poses, estimate));
    return evaluate_tracking(truth, transformed(tracks, T.inverse()), truth_poses);
  })));
}

py::dict mask_error(const std::filesystem::path& truth, const std::filesystem::path& results) {
  const SegmentationErrors errors = without_lock([&] {
    return segmentation_error(read_coco(truth), read_coco_results(results),
                              {.truth_name = truth.string(), .results_name = results.string()});
  });
  return dict_of(metric_values(errors.all));
}

}  // namespace

void bind_evaluation(py::module_& module) {
  module.def("evaluate_trajectory", &trajectory_error, py::arg("reference"), py::arg("estimate"),
             py::kw_only(), py::arg("max_difference") = 0.02, py::arg("align") = true,
             py::arg("rpe_delta") = py::none(), py::arg("rpe_unit") = "s",
             "Errors of a Trajectory against its reference, with the keys of mms eval trajectory.\n"
             "max_difference: of matched stamps [s]. align: rigidly, without scale.\n"
             "rpe_delta: of the relative error, in rpe_unit 's', 'm' or 'frames'; None: 1 s.\n"
             "Raises DataError if fewer than three poses match.");
  module.def(
      "evaluate_drift",
      [](const Trajectory& estimate) { return dict_of(metric_values(evaluate_drift(estimate))); },
      py::arg("estimate"),
      "Drift of a sensor that stands still, with the keys of mms eval drift. Raises DataError.");
  module.def(
      "evaluate_map", &map_error, py::arg("truth_static"), py::arg("truth_dynamic"), py::arg("map"),
      py::arg("radius") = 0.05,
      "Accuracy of a static map, with the keys of mms eval map.\n"
      "Three arrays N x 3 float32 in one frame [m], radius [m]. Raises ValueError, DataError.");
  module.def("align_truth", &truth_transform, py::arg("truth"), py::arg("estimate"),
             "4 x 4, world frame of the ground truth to that of the estimate [m].\n"
             "Raises DataError if no pose matches.");
  module.def("evaluate_objects", &object_error, py::arg("truth"), py::arg("tracks"),
             py::arg("truth_poses"), py::arg("estimate"),
             "Errors of tracked objects, with the keys of mms eval objects.\n"
             "truth, tracks: lists of ObjectFrame, in the frames of truth_poses and estimate.\n"
             "truth_poses, estimate: Trajectory. Raises DataError if no pose matches.");
  module.def("evaluate_masks", &mask_error, py::arg("truth"), py::arg("results"),
             "COCO numbers of mask results against ground truth, two JSON files, with the keys of\n"
             "mms eval segmentation. Raises FileError, DataError.");
}

}  // namespace mms::python
