#pragma once

#include "mms/core/random_stream.hpp"
#include "mms/training/data/sample.hpp"
#include "mms/training/data/training_config.hpp"

namespace mms {

/// Randomly mirrors and scales an image and places a random crop, or the whole with padding, on a
/// canvas of width x height [px] (large-scale jitter of the copy-paste paper). Drops objects with
/// less than `kMinObjectPixels` remaining pixels.
Sample jittered(const Sample& sample, int width, int height, const AugmentationConfig& config,
                RandomStream& random);

/// Changes light and sensor: brightness, contrast, saturation, hue, motion blur, noise.
void change_colors(Sample& sample, const AugmentationConfig& config, RandomStream& random);

/// Pastes a random subset of `source`'s objects onto `target` (equal sizes), removes them from the
/// masks below, and drops objects that are almost hidden.
void paste_objects(Sample& target, const Sample& source, RandomStream& random);

inline constexpr int kMinObjectPixels = 24;

}  // namespace mms
