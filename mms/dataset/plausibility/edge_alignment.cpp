#include "mms/dataset/plausibility/edge_alignment.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mms {
namespace {

// All limits come from the depth of the three real recordings and eight simulated scenes of
// docs/results.md, with right depth, mirrored, upside down, and seen by a second camera 2.5 cm
// beside with 0.92 of the focal length (mean rank of 8 frames each).

/// Fewer edges prove nothing. The scene with the fewest, `corridor`, has 535 in 8 frames.
constexpr std::size_t kMinEdges = 300;
/// [-]: gain of a mirrored image. Right depth: at most -0.07; mirrored: at least 0.05.
constexpr double kMirrorGain = 0.04;
/// [-]: gain of a warped image. Right depth: at most 0.002; unregistered: at least 0.06.
constexpr double kWarpGain = 0.04;
/// [-]: gain of a warp over that of a delay which it needs to be the better reason. There are 800
/// warps and ten delays, so that one of the warps fits a moving person by chance.
constexpr double kWarpsPerDelay = 2.0;
/// [-]: score that shows any alignment. Right depth: at least 0.81; edges anywhere: 0.65 to 0.74.
constexpr double kMinScore = 0.76;
/// [px]: least shift at the same scale. Depth measured 20 ms later than color moves by up to 8 px
/// in `fr1_xyz_clip`; cameras side by side differ by more, or in scale.
constexpr float kMinShift = 12.0F;

}  // namespace

void EdgeAlignment::add(ImageEdges frame) {
  edges_ += frame.edges.size();
  frames_.push_back(std::move(frame));
}

double EdgeAlignment::score(const EdgeWarp& warp) const {
  EdgeScore sum;
  for (const ImageEdges& frame : frames_) sum += score_edges(frame.edges, frame.gradient, warp);
  return sum.mean();
}

/// Scale and shift within which depth cameras differ from the color camera beside them.
std::optional<std::string> EdgeAlignment::unregistered(double score_as_is,
                                                       double delay_gain) const {
  EdgeWarp best;
  double best_score = 0.0;
  for (const float scale : {0.8F, 0.85F, 0.9F, 0.95F, 1.0F, 1.05F, 1.1F, 1.15F, 1.25F}) {
    for (int dx = -12; dx <= 12; dx += 2) {
      for (int dy = -6; dy <= 6; dy += 2) {
        const EdgeWarp warp{scale, scale, static_cast<float>(dx), static_cast<float>(dy)};
        const double found = score(warp);
        if (found > best_score) {
          best_score = found;
          best = warp;
        }
      }
    }
  }
  const double gain = std::max(kWarpGain, kWarpsPerDelay * delay_gain);
  if (best_score < std::max(kMinScore, score_as_is + gain)) return std::nullopt;
  const float shift = 2.0F * std::hypot(best.shift_x, best.shift_y);
  if (best.scale_x == 1.0F && shift < kMinShift) return std::nullopt;
  const int percent = static_cast<int>(std::lround(100.0F * best.scale_x));
  return "not registered: the edges fit the color images best if scaled to " +
         std::to_string(percent) + " % and moved by " +
         std::to_string(static_cast<int>(2.0F * best.shift_x)) + ", " +
         std::to_string(static_cast<int>(2.0F * best.shift_y)) + " px";
}

std::optional<std::string> EdgeAlignment::fault(double delay_gain) const {
  if (edges_ < kMinEdges) return std::nullopt;
  struct Turn {
    EdgeWarp warp;
    const char* name = "";
  };
  const Turn turns[] = {{{-1.0F, 1.0F}, "mirrored left to right"},
                        {{1.0F, -1.0F}, "mirrored top to bottom"},
                        {{-1.0F, -1.0F}, "turned by 180 degrees"}};
  const double as_is = score({});
  const Turn* best = nullptr;
  double best_score = std::max(kMinScore, as_is + kMirrorGain);
  for (const Turn& turn : turns) {
    const double found = score(turn.warp);
    if (found <= best_score) continue;
    best_score = found;
    best = &turn;
  }
  if (best != nullptr) return best->name;
  return unregistered(as_is, delay_gain);
}

}  // namespace mms
