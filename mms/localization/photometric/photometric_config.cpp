#include "mms/localization/photometric/photometric_config.hpp"

namespace mms {

void PhotometricConfig::visit(ConfigVisitor& v) {
  v.boolean({"enabled", "", "add photometric residuals to the geometric ones (images with depth)"},
            enabled);
  v.boolean({"hold_still", "", "hold the pose while the images show that the camera stands still"},
            hold_still);
  v.number({"min_gradient", "1/px", "least intensity gradient of a textured pixel"}, min_gradient,
           {0.5, 100.0});
  v.integer({"cell_px", "px", "one textured pixel is taken from a cell of this side"}, cell_px,
            {1, 32});
  v.number({"min_sigma", "", "least standard deviation of the residuals, in grey levels"},
           min_sigma, {0.1, 100.0});
  v.number({"weight", "", "weight of the photometric residuals against the geometric"}, weight,
           {0.0, 1000.0});
  v.number({"depth_gate", "m", "largest difference of predicted and measured depth, noise apart"},
           depth_gate, {0.0, 1.0});
  v.integer({"references", "", "keyframes a frame is compared with"}, references, {1, 8});
  v.number({"keyframe_translation", "m", "distance to all keyframes that makes a new one"},
           keyframe_translation, {0.001, 10.0});
  v.number({"keyframe_parallax", "", "the same as a share of the depth of what they see"},
           keyframe_parallax, {0.0, 1.0});
  v.number({"keyframe_rotation", "deg", "angle to all keyframes that makes a new one"},
           keyframe_rotation, {0.1, 90.0});
  v.integer({"max_keyframes", "", "keyframes kept; the farthest goes first"}, max_keyframes,
            {1, 10000});
}

}  // namespace mms
