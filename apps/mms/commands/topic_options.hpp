#pragma once

#include <CLI/CLI.hpp>

#include "mms/dataset/source/bag_topic_names.hpp"

namespace mms {

/// Adds the options for the topics of a bag: --topic-color and so on.
void add_topic_options(CLI::App& command, BagTopicNames& topics);

}  // namespace mms
