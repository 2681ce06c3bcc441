#pragma once

#include <CLI/CLI.hpp>

#include "mms/dataset/source/bag_topic_names.hpp"
#include "mms/dataset/source/motion_files.hpp"

namespace mms {

/// Adds the options for the topics of a bag: --topic-color and so on.
void add_topic_options(CLI::App& command, BagTopicNames& topics);

/// Adds --wheels and --imu.
void add_motion_options(CLI::App& command, MotionOptions& options);

}  // namespace mms
