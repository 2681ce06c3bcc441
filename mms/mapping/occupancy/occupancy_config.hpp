#pragma once

#include "mms/core/config_visitor.hpp"

namespace mms {

struct FloorConfig {
  double max_tilt = 40.0;  ///< [deg]
  double min_area = 1.0;   ///< [m^2]

  void visit(ConfigVisitor& v) {
    v.number(
        {"max_tilt", "deg", "largest angle between the first sensor pose's up and the floor's"},
        max_tilt, {0.0, 80.0});
    v.number({"min_area", "m^2", "least area of level surface that is a floor"}, min_area,
             {0.01, 1e4});
  }
};

struct GridConfig {
  double min_height = 0.15;  ///< [m]
  double max_height = 1.8;   ///< [m]
  double free_height = 0.5;  ///< [m]

  void visit(ConfigVisitor& v) {
    v.number({"min_height", "m", "height over the floor from which on points are obstacles"},
             min_height, {0.0, 10.0});
    v.number({"max_height", "m", "height over the floor up to which points are obstacles"},
             max_height, {0.0, 100.0});
    v.number({"free_height", "m", "empty space seen up to this height makes its floor free"},
             free_height, {0.0, 100.0});
  }
};

struct OccupancyConfig {
  bool enabled = true;
  double voxel_size = 0.1;       ///< [m]
  double max_range = 15.0;       ///< [m]
  double memory = 100.0;         ///< [MB]
  double hit = 0.7;              ///< probability
  double miss = 0.4;             ///< probability
  double min_probability = 0.1;  ///< clamping, so that changes are learned
  double max_probability = 0.9;
  FloorConfig floor{};
  GridConfig grid{};

  void visit(ConfigVisitor& v) {
    v.boolean({"enabled", "", "map free, occupied and unknown space for robots"}, enabled);
    v.number({"voxel_size", "m", "side of a voxel, doubled whenever the memory is used up"},
             voxel_size, {0.01, 10.0});
    v.number({"max_range", "m", "range up to which points are obstacles and space is freed"},
             max_range, {0.1, 1000.0});
    v.number({"memory", "MB", "budget of the map"}, memory, {1.0, 1e6});
    v.number({"hit", "", "probability that a voxel with a static point in it is occupied"}, hit,
             {0.55, 0.99});
    v.number({"miss", "", "probability that a voxel seen through is occupied"}, miss, {0.01, 0.45});
    v.number({"min_probability", "", "lower limit of a voxel's probability"}, min_probability,
             {0.01, 0.45});
    v.number({"max_probability", "", "upper limit of a voxel's probability"}, max_probability,
             {0.55, 0.99});
    v.group({"floor", "", "detection of the floor"}, floor);
    v.group({"grid", "", "heights that decide on a cell of the 2D grid"}, grid);
  }
};

}  // namespace mms
