#pragma once

#include <Eigen/Core>
#include <array>

#include "mms/core/config.hpp"
#include "mms/core/segmentation.hpp"

namespace mms {

/// What is known of the objects of a class before one was seen.
struct ClassPrior {
  double length = 0.5;       ///< along its way [m]
  double width = 0.5;        ///< [m]
  double height = 1.7;       ///< [m]
  double max_extent = 30.0;  ///< over the floor; what reaches farther is several objects [m]
  int views = 0;
  double min_score = 0.35;

  Eigen::Vector3d size() const { return {length, width, height}; }

  void visit(ConfigVisitor& v) {
    constexpr Range kSize = {0.05, 30.0};
    v.number({"length", "m", "along its heading"}, length, kSize);
    v.number({"width", "m", "across its heading"}, width, kSize);
    v.number({"height", "m", "from the floor up"}, height, kSize);
    v.number({"max_extent", "m", "over the floor, beyond which it is several objects"}, max_extent,
             kSize);
    v.integer({"views", "", "views of an object that this knowledge counts for"}, views,
              {0.0, 1000.0});
    v.number({"min_score", "", "mean confidence of its masks that makes it an object"}, min_score,
             {0.0, 1.0});
  }
};

/// How a tracked object moves and is seen.
struct TrackConfig {
  double acceleration_noise = 0.2;  ///< spectral density [m^2/s^3]
  double position_sigma = 0.03;     ///< of a box's center [m]
  double truncated_sigma = 0.1;     ///< of one with an end out of view [m]
  double unanchored_sigma = 0.25;   ///< of one that no end in view holds [m]
  double max_speed = 3.0;           ///< [m/s]
  double moving_speed = 0.2;        ///< [m/s]
  double stopped_speed = 0.12;      ///< [m/s]
  std::array<ClassPrior, kTrackedClassCount> classes{{{0.6, 0.5, 1.7, 1.1, 20, 0.35},
                                                      {1.2, 0.8, 1.2, 30.0, 1, 0.5},
                                                      {0.5, 0.5, 1.0, 30.0, 1, 0.0}}};

  /// Whether an object of that speed [m/s] moves, which did so before or not.
  bool is_moving(double speed, bool before) const {
    return speed > (before ? stopped_speed : moving_speed);
  }

  void visit(ConfigVisitor& v) {
    v.number({"acceleration_noise", "m^2/s^3", "how quickly objects change their velocity"},
             acceleration_noise, {1e-4, 100.0});
    v.number({"position_sigma", "m", "error of the center of a box in view"}, position_sigma,
             {1e-3, 10.0});
    v.number({"truncated_sigma", "m", "error of the center of a box with an end out of view",
              "cut_sigma"},
             truncated_sigma, {1e-3, 10.0});
    v.number({"unanchored_sigma", "m", "error of the center of a box that no end in view holds",
              "loose_sigma"},
             unanchored_sigma, {1e-3, 10.0});
    v.number({"max_speed", "m/s", "fastest object"}, max_speed, {0.1, 100.0});
    v.number({"moving_speed", "m/s", "from which a standing object is said to move"}, moving_speed,
             {0.0, 10.0});
    v.number({"stopped_speed", "m/s", "below which a moving object is said to stand"},
             stopped_speed, {0.0, 10.0});
    v.group({"person", "", "a person before it was seen"}, classes[0]);
    v.group({"agv", "", "a vehicle before it was seen"}, classes[1]);
    v.group({"unknown", "", "moving objects of unknown class, before their size was measured"},
            classes[2]);
  }
};

}  // namespace mms
