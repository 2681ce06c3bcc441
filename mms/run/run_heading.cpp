#include "mms/run/run_heading.hpp"

#include <fmt/core.h>

#include "mms/run/segmenter/network_detector.hpp"

namespace mms {
namespace {

/// The fact "key: value" of a recording; empty if it has none.
std::string fact_of(const std::vector<std::string>& facts, const std::string& key) {
  for (const std::string& fact : facts) {
    if (fact.starts_with(key + ": ")) return fact.substr(key.size() + 2);
  }
  return "";
}

/// What is before the first comma.
std::string first_part(const std::string& text) {
  return text.substr(0, text.find(','));
}

std::string masks_of(const RunOptions& options, const SystemConfig& config) {
  if (options.segmenter == "network") {
    return "network " + weights_path(config.segmentation.weights).filename().string();
  }
  if (options.segmenter == "none") return "none";
  return options.masks.empty() ? "of the recording" : options.masks.string();
}

}  // namespace

std::vector<std::string> run_heading(const RunOptions& options, const FrameSource& source,
                                     const SystemConfig& config, std::size_t frames,
                                     const std::filesystem::path& folder) {
  const std::vector<std::string> facts = source.describe();
  const std::string count =
      frames == FrameSource::kEndless ? "until Ctrl-C" : fmt::format("{} frames", frames);
  return {
      fmt::format("recording  {}, {} ({})", options.data, count,
                  first_part(fact_of(facts, "layout"))),
      fmt::format("sensor     {}; masks: {}", fact_of(facts, "sensor"), masks_of(options, config)),
      fmt::format("results    {}", folder.string())};
}

}  // namespace mms
