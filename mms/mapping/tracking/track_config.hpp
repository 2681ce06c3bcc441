#pragma once

#include <Eigen/Core>
#include <array>

#include "mms/core/config_visitor.hpp"
#include "mms/core/segmentation.hpp"

namespace mms {

/// What is known of the objects of a class before one was seen.
struct ClassPrior {
  double length = 0.5;       ///< along its heading [m]
  double width = 0.5;        ///< [m]
  double height = 1.7;       ///< [m]
  double max_extent = 30.0;  ///< over the floor; a larger cluster is several objects [m]
  int views = 0;             ///< weight of this size in the mean of the measured ones
  double min_score = 0.35;   ///< mean confidence of the masks of an object

  Eigen::Vector3d size() const { return {length, width, height}; }

  void visit(ConfigVisitor& v) {
    constexpr Range kSize = {0.05, 30.0};
    v.number({"length", "m", "along its heading"}, length, kSize);
    v.number({"width", "m", "across its heading"}, width, kSize);
    v.number({"height", "m", "from the floor up"}, height, kSize);
    v.number({"max_extent", "m", "over the floor, beyond which it is several objects"}, max_extent,
             kSize);
    v.integer({"views", "", "weight of this prior size, in views of the object"}, views,
              {0.0, 1000.0});
    v.number({"min_score", "", "mean confidence of its masks that makes it an object"}, min_score,
             {0.0, 1.0});
  }
};

/// How a tracked object moves and is measured.
struct TrackConfig {
  double acceleration_noise = 0.2;      ///< spectral density [m^2/s^3]
  double initial_position_sigma = 0.2;  ///< [m]: half a person's depth, hidden in the first view
  double initial_velocity_sigma = 0.7;  ///< [m/s]: half the usual walking speed of 1.4 m/s
  double position_sigma = 0.03;         ///< of a box's center [m]
  double range_sigma = 0.005;      ///< [-]: mask boundaries off by 3 px at a focal length of 600 px
  double truncated_sigma = 0.1;    ///< of a center with one end of the box out of view [m]
  double unanchored_sigma = 0.25;  ///< of a center with both ends of the box out of view [m]
  double max_speed = 3.0;          ///< [m/s]
  double moving_speed = 0.2;       ///< [m/s]
  double stopped_speed = 0.12;     ///< [m/s]
  std::array<ClassPrior, kTrackedClassCount> classes{{
      // Person, vehicle, unknown.
      {.length = 0.6, .max_extent = 1.1, .views = 20},
      {.length = 1.2, .width = 0.8, .height = 1.2, .views = 1, .min_score = 0.5},
      {.height = 1.0, .views = 1, .min_score = 0.0},
  }};

  /// Whether an object of that speed [m/s] moves, given whether it moved before (hysteresis).
  bool is_moving(double speed, bool before) const {
    return speed > (before ? stopped_speed : moving_speed);
  }

  void visit(ConfigVisitor& v) {
    v.number({"acceleration_noise", "m^2/s^3", "how quickly objects change their velocity"},
             acceleration_noise, {1e-4, 100.0});
    v.number({"initial_position_sigma", "m", "error of a new track's position"},
             initial_position_sigma, {1e-3, 10.0});
    v.number({"initial_velocity_sigma", "m/s", "standard deviation of a new track's velocity"},
             initial_velocity_sigma, {1e-3, 100.0});
    v.number({"position_sigma", "m", "error of the center of a box in view"}, position_sigma,
             {1e-3, 10.0});
    v.number({"range_sigma", "", "growth of the center's error with its distance"}, range_sigma,
             {0.0, 1.0});
    v.number({"truncated_sigma", "m", "error of the center of a box with an end out of view",
              "cut_sigma"},
             truncated_sigma, {1e-3, 10.0});
    v.number({"unanchored_sigma", "m", "error of the center of a box with both ends out of view",
              "loose_sigma"},
             unanchored_sigma, {1e-3, 10.0});
    v.number({"max_speed", "m/s", "fastest object"}, max_speed, {0.1, 100.0});
    v.number({"moving_speed", "m/s", "speed above which a standing object moves"}, moving_speed,
             {0.0, 10.0});
    v.number({"stopped_speed", "m/s", "speed below which a moving object stands"}, stopped_speed,
             {0.0, 10.0});
    v.group({"person", "", "a person before it was seen"}, classes[0]);
    v.group({"agv", "", "a vehicle before it was seen"}, classes[1]);
    v.group({"unknown", "", "moving objects of unknown class, before their size was measured"},
            classes[2]);
  }
};

}  // namespace mms
