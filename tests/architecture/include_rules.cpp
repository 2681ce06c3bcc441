#include "tests/architecture/include_rules.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <regex>

namespace mms::testing {
namespace fs = std::filesystem;
namespace {

constexpr std::array kTops = {"mms", "apps", "interfaces", "benchmarks", "examples", "tests"};

std::vector<fs::path> sources_below(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path extension = entry.path().extension();
    if (extension == ".hpp" || extension == ".cpp") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Where a source lies: "segmentation" and "engine/graph" of
/// "mms/segmentation/engine/graph/plan.hpp".
struct Place {
  std::string module;
  std::string folder;
};

/// Both empty for a file in no module.
Place place_of(const fs::path& path) {
  const std::vector<fs::path> parts(path.begin(), path.end());
  Place place;
  std::size_t first = 1;
  if (parts.size() < 2) return place;
  if (parts[0] == "mms") {
    if (parts.size() < 3) return place;
    place.module = parts[1].string();
    first = 2;
  } else {
    place.module = parts[0].string();
    if (place.module == "apps") first = 2;  // apps/mms is one module
  }
  for (std::size_t i = first; i + 1 < parts.size(); ++i) {
    place.folder += (place.folder.empty() ? "" : "/") + parts[i].string();
  }
  return place;
}

std::string listed(const std::set<std::string>& modules) {
  std::string text;
  for (const std::string& module : modules) text += (text.empty() ? "" : ", ") + module;
  return text.empty() ? "none" : text;
}

/// Checks one file, line by line.
class FileCheck {
 public:
  FileCheck(const fs::path& root, const fs::path& file, const IncludeRules& rules)
      : file_(fs::relative(file, root)), place_(place_of(file_)), rules_(rules) {}

  std::vector<std::string> run(std::istream& text) {
    if (!rules_.modules.contains(place_.module)) {
      fail(1, "module '" + place_.module + "' has no rules: add it to tests/architecture");
      return std::move(faults_);
    }
    if (layered() && level_of(place_.folder) == folders().end()) {
      fail(1, "folder '" + place_.folder + "' of module '" + place_.module +
                  "' has no place: add it to tests/architecture");
      return std::move(faults_);
    }
    bool once = file_.extension() != ".hpp";
    std::string line;
    for (int number = 1; std::getline(text, line); ++number) {
      once = once || line == "#pragma once";
      check_line(line, number);
    }
    if (!once) fail(1, "a header without #pragma once");
    return std::move(faults_);
  }

 private:
  bool layered() const { return rules_.folders.contains(place_.module); }
  const std::vector<std::string>& folders() const { return rules_.folders.at(place_.module); }
  std::vector<std::string>::const_iterator level_of(const std::string& folder) const {
    return std::find(folders().begin(), folders().end(), folder);
  }

  void check_line(const std::string& line, int number) {
    static const std::regex kInclude(R"(^\s*#\s*include\s*(["<])([^">]*)[">].*)");
    std::smatch match;
    if (!std::regex_match(line, match, kInclude)) return;
    const std::string header = match[2];
    const bool quoted = match[1] == "\"";
    const bool from_root =
        header.find("..") == std::string::npos && !place_of(header).module.empty();
    if (quoted && !from_root) {
      fail(number, "includes \"" + header + "\", allowed: \"mms/MODULE/...\" from the root");
    } else if (!quoted && header.find("mms/") != std::string::npos) {
      fail(number, "includes <" + header + ">, project headers are included in quotes");
    } else if (quoted) {
      check_module(header, number);
    }
  }

  void check_module(const std::string& header, int number) {
    const Place target = place_of(header);
    const std::set<std::string>& targets = rules_.modules.at(place_.module);
    if (target.module == place_.module) {
      check_folder(header, target.folder, number);
    } else if (!targets.contains(target.module)) {
      fail(number, "includes \"" + header + "\": arrow " + place_.module + " -> " + target.module +
                       " is forbidden, allowed: " + listed(targets));
    }
  }

  void check_folder(const std::string& header, const std::string& target, int number) {
    if (!layered() || level_of(target) <= level_of(place_.folder)) return;
    fail(number, "includes \"" + header + "\": folder '" + target + "' lies above '" +
                     place_.folder + "' in module '" + place_.module + "'");
  }

  void fail(int number, const std::string& what) {
    faults_.push_back(file_.generic_string() + ":" + std::to_string(number) + ": " + what);
  }

  fs::path file_;
  Place place_;
  const IncludeRules& rules_;
  std::vector<std::string> faults_;
};

void check_sizes(const fs::path& root, const std::map<fs::path, std::size_t>& sizes,
                 std::vector<std::string>& faults) {
  for (const auto& [folder, files] : sizes) {
    if (files <= kMaxFilesInFolder) continue;
    faults.push_back(fs::relative(folder, root).generic_string() + ": " + std::to_string(files) +
                     " sources, at most " + std::to_string(kMaxFilesInFolder) +
                     " are allowed: split it by idea");
  }
}

/// Two headers of one name would be two ideas, or one in two places.
void check_names(const fs::path& root, const std::vector<fs::path>& files,
                 std::vector<std::string>& faults) {
  std::map<fs::path, fs::path> first;
  for (const fs::path& file : files) {
    if (file.extension() != ".hpp") continue;
    const auto [known, is_new] = first.try_emplace(file.filename(), file);
    if (is_new) continue;
    faults.push_back(fs::relative(file, root).generic_string() + ": the name of " +
                     fs::relative(known->second, root).generic_string() +
                     ": choose another or merge them");
  }
}

std::set<std::string> all_of(const IncludeRules& rules) {
  std::set<std::string> all;
  for (const auto& [module, targets] : rules.modules) all.insert(module);
  return all;
}

IncludeRules make_rules() {
  IncludeRules rules;
  rules.modules = {
      {"core", {}},
      {"geometry", {"core"}},
      {"segmentation", {"core"}},
      {"fusion", {"core", "geometry"}},
      {"localization", {"core", "geometry"}},
      {"mapping", {"core", "geometry"}},
      {"global_map", {"core", "geometry", "localization", "mapping"}},
      {"pipeline",
       {"core", "geometry", "segmentation", "fusion", "localization", "mapping", "global_map"}},
      {"io", {"core", "geometry"}},
      {"storage", {"core", "io"}},
      {"map_file", {"core", "geometry", "io", "storage", "mapping", "global_map"}},
      {"simulation", {"core", "geometry"}},
      {"ros", {"core", "geometry", "io", "storage"}},
      {"result_messages",
       {"core", "geometry", "io", "ros", "fusion", "localization", "mapping", "pipeline"}},
      {"dataset", {"core", "geometry", "io", "ros", "simulation"}},
      {"evaluation", {"core", "geometry", "io"}},
      {"report", {"core", "geometry", "io", "evaluation"}},
      {"training", {"core", "geometry", "io", "segmentation", "evaluation", "report"}},
      {"server", {"core", "geometry", "io"}},
  };
  rules.modules["run"] = all_of(rules);
  rules.modules["run"].erase("training");
  rules.modules["ros2"] = {"core",           "geometry", "io",       "ros",     "fusion",
                           "localization",   "mapping",  "pipeline", "dataset", "simulation",
                           "result_messages"};
  const std::set<std::string> library = all_of(rules);
  for (const char* user : {"apps", "interfaces", "benchmarks", "examples"}) {
    rules.modules[user] = library;
  }
  rules.modules["tests"] = all_of(rules);
  rules.folders = {
      {"geometry", {"voxels", ""}},
      {"segmentation",
       {"solo", "weights", "detection", "engine/graph", "engine", "engine/calibration", "network",
        "onnx", "segmenters"}},
      {"fusion", {"config", "clouds", "planes", "clusters", "masks", ""}},
      {"localization", {"features", "motion", "photometric", "registration", "", "robot_body"}},
      {"mapping",
       {"free_space", "motion_segmentation", "static_map", "occupancy", "ground", "tracking"}},
      {"global_map", {"places", "keyframes", "loops", "graph", ""}},
      {"io",
       {"text", "config", "cloud", "image", "video", "capture", "weights", "journal", "motion",
        "results", "opencv", "stb"}},
      {"ros", {"", "storage", "bag"}},
      {"simulation",
       {"models", "people", "vehicles", "sensors", "config", "building", "world", "truth", ""}},
      {"dataset",
       {"source", "live", "recorder", "bag", "folder", "lidar", "numbered", "simulated", "tum",
        "video", "capture", "camera", "plausibility", ""}},
      {"evaluation", {"scores", "trajectory", "map", "segmentation", "tracking", ""}},
      {"training", {"data", "processes", "run"}},
      {"server", {"scene", "viewer", "http"}},
      {"run", {"record", "segmenter", "results", "view", ""}},
      {"apps",
       {"console", "paper", "batch", "commands", "commands/eval", "commands/live",
        "commands/network", ""}},
  };
  return rules;
}

}  // namespace

const IncludeRules& include_rules() {
  static const IncludeRules kRules = make_rules();
  return kRules;
}

std::vector<std::string> include_faults(const fs::path& root, const IncludeRules& rules) {
  std::vector<std::string> faults;
  std::map<fs::path, std::size_t> sizes;
  std::vector<fs::path> all;
  for (const char* top : kTops) {
    for (const fs::path& file : sources_below(root / top)) {
      all.push_back(file);
      ++sizes[file.parent_path()];
      std::ifstream text(file);
      for (std::string& fault : FileCheck(root, file, rules).run(text)) {
        faults.push_back(std::move(fault));
      }
    }
  }
  check_sizes(root, sizes, faults);
  check_names(root, all, faults);
  return faults;
}

}  // namespace mms::testing
