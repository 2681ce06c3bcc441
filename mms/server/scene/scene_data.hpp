#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mms/core/calibration.hpp"
#include "mms/core/image.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/core/object_box.hpp"
#include "mms/core/odometry_estimate.hpp"
#include "mms/io/journal/disk_log.hpp"

namespace mms {

/// A value per frame, plotted over time. Its unit is "" if it has none.
struct SeriesName {
  std::string name;
  std::string unit;
};

/// Constant information about a run.
struct SceneInfo {
  std::string id;     ///< unique id of the run
  std::string name;   ///< for the title
  std::string data;   ///< input of the run, as the user gave it
  bool live = false;  ///< the run continues
  std::optional<CameraIntrinsics> camera;
  std::optional<std::size_t> frames;  ///< total number, if known
  bool has_truth = false;
  bool has_pictures = true;            ///< images, masks and scans are available
  std::string pictures_note;           ///< reason if they are not
  double voxel_size = 0.0;             ///< of the map [m]
  Eigen::Vector3d up{0.0, -1.0, 0.0};  ///< in the world frame, unit
  std::vector<SeriesName> series;
};

/// One frame for viewers, without sensor data.
struct SceneFrame {
  Timestamp stamp;
  Transform<World, Sensor> T_world_sensor;
  Status status = Status::kTracking;
  std::vector<float> series;             ///< parallel to SceneInfo::series; NaN: unknown
  std::vector<ObjectBox> objects;        ///< `visible` is 0 if not in view
  std::optional<Eigen::Vector3d> truth;  ///< ground-truth position in the world frame [m]
};

/// A possible loop between two frames that was checked.
struct SceneLoop {
  std::size_t earlier = 0;  ///< index of the frame
  std::size_t later = 0;
  bool is_accepted = false;
  std::string outcome;  ///< "accepted", or the check that failed
};

/// For `DiskLog`.
template <class Visitor>
void visit_fields(Visitor& v, SceneFrame& frame) {
  v(frame.stamp);
  visit_fields(v, frame.T_world_sensor);
  v(frame.status);
  visit_all(v, frame.series, [&](float& value) { v(value); });
  visit_all(v, frame.objects, [&](ObjectBox& box) { visit_fields(v, box); });
  bool has_truth = frame.truth.has_value();
  Eigen::Vector3d truth = frame.truth.value_or(Eigen::Vector3d::Zero());
  v(has_truth);
  visit_fields(v, truth);
  if (has_truth) frame.truth = truth;
}

/// Sensor data of a frame and its segmentation.
struct SensorView {
  std::size_t frame = 0;  ///< index in the run
  Image<Rgb> color;       ///< may be empty
  LabeledCloud cloud;
};

/// Points with colors; the vectors are parallel.
struct ColoredPoints {
  std::vector<Eigen::Vector3f> points;  ///< [m]
  std::vector<Rgb> colors;
};

}  // namespace mms
