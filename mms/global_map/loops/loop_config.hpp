#pragma once

#include "mms/core/config_visitor.hpp"

namespace mms {

/// Checks of a loop.
struct LoopConfig {
  int min_inliers = 20;
  int min_scan_inliers = 10;
  double min_overlap = 0.2;
  double max_contradiction = 0.02;
  double max_dissimilarity = 0.15;

  void visit(ConfigVisitor& v) {
    v.integer({"min_inliers", "", "pairs of keypoints that must agree with the relative pose"},
              min_inliers, {6, 10000});
    v.integer({"min_scan_inliers", "", "the same of LiDAR scans, whose keypoints are on the floor"},
              min_scan_inliers, {4, 10000});
    v.number({"min_overlap", "",
              "share of the static points of each view that must lie on surfaces of the other"},
             min_overlap, {0.0, 1.0});
    v.number({"max_contradiction", "",
              "largest share of points in view that lie in free space of the other view"},
             max_contradiction, {0.0, 1.0});
    v.number({"max_dissimilarity", "",
              "largest share of weakly textured patches of both views that do not correlate"},
             max_dissimilarity, {0.0, 1.0});
  }
};

}  // namespace mms
