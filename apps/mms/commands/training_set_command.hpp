#pragma once

#include <CLI/App.hpp>

namespace mms {

/// Adds `mms simulate training-set -o DIR --images N`, which writes single images with COCO
/// annotations for training a segmentation network.
void add_training_set_command(CLI::App& simulate);

}  // namespace mms
