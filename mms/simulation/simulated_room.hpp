#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "mms/core/config.hpp"
#include "mms/core/frame.hpp"
#include "mms/core/segmentation.hpp"
#include "mms/core/trajectory.hpp"
#include "mms/simulation/moving_object.hpp"
#include "mms/simulation/solid.hpp"

namespace mms {

struct RoomConfig {
  int frames = 150;
  double hz = 15.0;  ///< [1/s]
  int seed = 1;
  int width = 640;   ///< [px]
  int height = 480;  ///< [px]
  int people = 3;
  bool moving_objects = true;
  bool moving_camera = true;
  bool noise = true;
  double max_depth = 8.0;  ///< [m]

  void visit(ConfigVisitor& v) {
    v.integer({"frames", "", "length of the recording"}, frames, {1.0, 1e6});
    v.number({"hz", "1/s", "frame rate"}, hz, {0.1, 1000.0});
    v.integer({"seed", "", "of textures, ways and noise"}, seed, {0.0, 1e9});
    v.integer({"width", "px", "image width"}, width, {16.0, 4096.0});
    v.integer({"height", "px", "image height"}, height, {16.0, 4096.0});
    v.integer({"people", "", "persons walking about"}, people, {0.0, 8.0});
    v.boolean({"moving_objects", "", "whether there are persons and an AGV at all"},
              moving_objects);
    v.boolean({"moving_camera", "", "whether the camera drives or stands still"}, moving_camera);
    v.boolean({"noise", "", "whether depth and colour are noisy"}, noise);
    v.number({"max_depth", "m", "farthest depth the camera measures"}, max_depth, {0.5, 100.0});
  }
};

/// A moving object as it truly is at one frame.
struct SimulatedObject {
  int id = 0;  ///< from 0 on, the same in all frames
  ObjectClass object_class = ObjectClass::kPerson;
  Eigen::Isometry3d T_world_box = Eigen::Isometry3d::Identity();  ///< box centre, x forward, z up
  Eigen::Vector3d half_extent = Eigen::Vector3d::Zero();          ///< of the box [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();             ///< world frame [m/s]
};

/// A furnished room with persons and an AGV crossing before a driving RGB-D camera: small, quick
/// and exact, for demos and tests. Any frame can be rendered at any time; the same config gives the
/// same bits, whatever the number of threads.
class SimulatedRoom {
 public:
  explicit SimulatedRoom(const RoomConfig& config = {});

  const RoomConfig& config() const { return config_; }
  int size() const { return config_.frames; }

  /// Colour, depth registered to it, and the exact mask. Indices beyond the end go on in time.
  Frame render(int index) const;

  /// The camera's pose; the world frame is the camera's at frame 0.
  StampedPose truth(int index) const;

  std::vector<SimulatedObject> objects(int index) const;

 private:
  double seconds(int index) const { return index / config_.hz; }
  Timestamp stamp(int index) const { return Timestamp::from_seconds(seconds(index)); }
  Eigen::Isometry3d T_room_camera(int index) const;
  std::vector<Solid> solids(int index) const;

  RoomConfig config_;
  std::shared_ptr<const Calibration> calibration_;
  std::vector<Solid> furniture_;
  std::vector<MovingObject> movers_;
};

}  // namespace mms
