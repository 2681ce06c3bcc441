#include "tests/architecture/include_rules.hpp"

#include <algorithm>
#include <fstream>
#include <regex>

namespace mms::testing {
namespace fs = std::filesystem;
namespace {

std::vector<fs::path> sources_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path extension = entry.path().extension();
    if (extension == ".hpp" || extension == ".cpp") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// "core" of "mms/core/frame.hpp"; empty for a file in no module.
std::string module_of(const fs::path& path) {
  const std::vector<fs::path> parts(path.begin(), path.end());
  return parts.size() > 2 ? parts[1].string() : "";
}

std::string listed(const std::set<std::string>& modules) {
  std::string text;
  for (const std::string& module : modules) text += (text.empty() ? "" : ", ") + module;
  return text.empty() ? "none" : text;
}

/// Checks one file, line by line.
class FileCheck {
 public:
  FileCheck(const fs::path& root, const fs::path& file, const Arrows& allowed)
      : file_(fs::relative(file, root)), module_(module_of(file_)), allowed_(allowed) {}

  std::vector<std::string> run(std::istream& text) {
    if (!allowed_.contains(module_)) {
      fail(1, "module '" + module_ + "' has no arrows: add it to tests/architecture");
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
  void check_line(const std::string& line, int number) {
    static const std::regex kInclude(R"(^\s*#\s*include\s*(["<])([^">]*)[">].*)");
    std::smatch match;
    if (!std::regex_match(line, match, kInclude)) return;
    const std::string header = match[2];
    const bool quoted = match[1] == "\"";
    const bool from_root = header.starts_with("mms/") && header.find("..") == std::string::npos;
    if (quoted && !from_root) {
      fail(number, "includes \"" + header + "\", allowed is \"mms/MODULE/...\" from the root");
    } else if (!quoted && header.find("mms/") != std::string::npos) {
      fail(number, "includes <" + header + ">, project headers are included in quotes");
    } else if (quoted) {
      check_arrow(header, number);
    }
  }

  void check_arrow(const std::string& header, int number) {
    const std::string target = module_of(header);
    const std::set<std::string>& targets = allowed_.at(module_);
    if (target == module_ || targets.contains(target)) return;
    fail(number, "includes \"" + header + "\": arrow " + module_ + " -> " + target +
                     " is forbidden, allowed are: " + listed(targets));
  }

  void fail(int number, const std::string& what) {
    faults_.push_back(file_.generic_string() + ":" + std::to_string(number) + ": " + what);
  }

  fs::path file_;
  std::string module_;
  const Arrows& allowed_;
  std::vector<std::string> faults_;
};

}  // namespace

const Arrows& arrows() {
  static const Arrows kArrows = {
      {"core", {}},
      {"geometry", {"core"}},
      {"segmentation", {"core"}},
      {"fusion", {"core", "geometry"}},
      {"localization", {"core", "geometry"}},
      {"mapping", {"core", "geometry"}},
      {"training", {"core", "geometry", "io", "segmentation", "evaluation"}},
      {"pipeline", {"core", "geometry", "segmentation", "fusion", "localization", "mapping"}},
      {"io", {"core", "geometry"}},
      {"simulation", {"core", "geometry"}},
      {"ros", {"core", "geometry", "io"}},
      {"dataset", {"core", "geometry", "io", "ros", "simulation"}},
      {"evaluation", {"core", "geometry", "io"}},
      {"server", {"core", "geometry", "io"}},
  };
  return kArrows;
}

std::vector<std::string> include_faults(const fs::path& root, const Arrows& allowed) {
  std::vector<std::string> faults;
  for (const fs::path& file : sources_below(root / "mms")) {
    std::ifstream text(file);
    for (std::string& fault : FileCheck(root, file, allowed).run(text)) {
      faults.push_back(std::move(fault));
    }
  }
  return faults;
}

}  // namespace mms::testing
