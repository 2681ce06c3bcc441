#pragma once

#include "mms/core/random_stream.hpp"
#include "mms/training/data/sample.hpp"
#include "mms/training/data/training_config.hpp"

namespace mms {

/// Mirrors a picture perhaps, scales it by chance, and lays a random part of it, or the whole with
/// padding, on a canvas of width x height [px] (large-scale jitter of the copy-paste paper).
/// Objects of which less than `kMinObjectPixels` pixels are left are dropped.
Sample jittered(const Sample& sample, int width, int height, const AugmentationConfig& config,
                RandomStream& random);

/// Changes of light and sensor: brightness, contrast, saturation, hue, motion blur, noise.
void change_colors(Sample& sample, const AugmentationConfig& config, RandomStream& random);

/// Pastes a random choice of `source`'s objects over `target` (both of one size), cuts them out of
/// the masks below, and drops objects that are hidden but for a small rest.
void paste_objects(Sample& target, const Sample& source, RandomStream& random);

inline constexpr int kMinObjectPixels = 24;

}  // namespace mms
