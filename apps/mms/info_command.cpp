#include "info_command.hpp"

#include <fmt/core.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "mms/dataset/open_dataset.hpp"

namespace mms {
namespace {

struct InfoOptions {
  std::string data;
  std::string masks;
};

/// Reads one frame of a freshly opened recording. @returns what is wrong with it, or nothing.
std::string fault_of_frame(const InfoOptions& options, std::size_t index) {
  const auto source = open_dataset(options.data, {.masks = options.masks});
  std::vector<std::string> warnings;
  source->on_warning([&](const std::string& message) { warnings.push_back(message); });
  warnings.clear();  // those of opening, which print_info shows
  source->skip(index);
  const auto frame = source->next();
  const bool read = frame && frame->index == static_cast<std::int64_t>(index);
  return read || warnings.empty() ? "" : warnings.front();
}

void print_frame_checks(const InfoOptions& options, std::size_t size) {
  const std::set<std::size_t> checked = {0, size / 2, size - 1};
  for (const std::size_t index : checked) {
    const std::string fault = fault_of_frame(options, index);
    fmt::print("frame {}: {}\n", index, fault.empty() ? "readable" : fault);
  }
}

void print_info(const InfoOptions& options) {
  const auto source = open_dataset(options.data, {.masks = options.masks});
  for (const std::string& line : source->describe()) fmt::print("{}\n", line);
  source->on_warning([](const std::string& message) { fmt::print("warning: {}\n", message); });
  if (source->size() > 0) print_frame_checks(options, source->size());
}

}  // namespace

void add_info_command(CLI::App& app) {
  const auto options = std::make_shared<InfoOptions>();
  CLI::App* command = app.add_subcommand("info", "Show what a recording holds");
  command->add_option("DATA", options->data, "folder of the recording, or sim:SCENE")->required();
  command->add_option("--masks", options->masks, "folder of label images named like the frames");
  command->callback([options] { print_info(*options); });
}

}  // namespace mms
