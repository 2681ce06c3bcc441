#pragma once

#include <CLI/CLI.hpp>

#include "mms/dataset/bag_topics.hpp"

namespace mms {

/// Adds the options that name the topics of a bag: --topic-color and so on.
void add_topic_options(CLI::App& command, BagTopicNames& topics);

}  // namespace mms
