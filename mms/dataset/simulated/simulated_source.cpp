#include "mms/dataset/simulated/simulated_source.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/dataset/simulated/scene_source.hpp"
#include "mms/io/config/config_assignments.hpp"
#include "mms/io/text/nearest_word.hpp"

namespace mms {
namespace {

constexpr std::string_view kScheme = "sim:";

/// Parts of "sim:name?key=value&key=value".
struct Address {
  std::string text;
  std::string scene;
  std::vector<std::string> assignments;
};

Address parse(std::string_view text) {
  const std::string_view body = text.substr(kScheme.size());
  const std::size_t mark = std::min(body.find('?'), body.size());
  Address address{std::string(text), std::string(body.substr(0, mark)), {}};
  std::string_view query = body.substr(std::min(body.size(), mark + 1));
  while (!query.empty()) {
    const std::string_view part = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(query.size(), part.size() + 1));
    address.assignments.emplace_back(part);
  }
  return address;
}

[[noreturn]] void fail_unknown(const Address& address) {
  std::vector<std::string> known;
  for (const std::string_view name : scene_names()) {
    known.push_back(std::string(kScheme).append(name));
  }
  throw DataError(address.text, "no such scene",
                  suggestion(std::string(kScheme) + address.scene, known));
}

}  // namespace

bool is_simulated(std::string_view address) {
  return address.starts_with(kScheme);
}

SceneConfig simulated_scene(std::string_view text) {
  if (!is_simulated(text)) throw DataError(std::string(text), "is not a simulation");
  const Address address = parse(text);
  const auto names = scene_names();
  if (std::find(names.begin(), names.end(), address.scene) == names.end()) fail_unknown(address);
  SceneConfig config = scene_config(address.scene);
  assign(config, address.assignments, address.text);
  return config;
}

std::unique_ptr<FrameSource> open_simulated(std::string_view text, const SourceOptions& options) {
  if (!options.masks.empty()) {
    throw DataError(std::string(text), "cannot take masks from " + options.masks.string(),
                    "a simulation brings its own masks");
  }
  return play_scene(simulated_scene(text), options.load_masks, options.map_truth);
}

}  // namespace mms
