#include "tests/architecture/constant_rules.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <regex>
#include <set>
#include <sstream>

namespace mms::testing {
namespace fs = std::filesystem;
namespace {

const std::set<std::string> kUnits = {"-",   "1",      "m",     "px",     "s",  "deg",
                                      "rad", "voxels", "nodes", "frames", "ms", "grey levels"};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

struct Line {
  std::string code;
  std::string comment;
};

/// Strings and characters are left out of the code, so that no sign in them counts.
Line divided(const std::string& line) {
  static const std::regex kText(R"("(\\.|[^"\\])*"|'(\\.|[^'\\])')");
  const std::string plain = std::regex_replace(line, kText, "\"\"");
  const std::size_t begin = std::min(plain.find("//"), plain.size());
  std::string comment = plain.substr(begin);
  comment.erase(0, comment.find_first_not_of("/<"));
  return {plain.substr(0, begin), comment};
}

bool is_blank(const std::string& code) {
  return code.find_first_not_of(" \t") == std::string::npos;
}

struct Constant {
  std::string name;
  std::string code;
  std::string comment;
};

/// The constant that begins in line `first`; nothing where there is none.
std::optional<Constant> constant_at(const std::vector<std::string>& lines, std::size_t first) {
  static const std::regex kBegin(R"(^(inline |static )*(constexpr|const) .*)");
  static const std::regex kWhole(R"([^=({]*\s(\w+)(\[[^\]]*\])*\s*[={].*;\s*)");
  if (!std::regex_match(divided(lines[first]).code, kBegin)) return std::nullopt;
  Constant constant;
  for (std::size_t i = first; i-- > 0;) {
    const Line above = divided(lines[i]);
    if (!is_blank(above.code) || above.comment.empty()) break;
    constant.comment.insert(0, above.comment + " ");
  }
  for (std::size_t i = first; i < lines.size(); ++i) {
    const Line line = divided(lines[i]);
    // After the semicolon only an indented comment belongs to the constant.
    const bool is_complete = constant.code.find(';') != std::string::npos;
    if (is_complete && (line.code.empty() || !is_blank(line.code))) break;
    constant.code += line.code;
    constant.comment += " " + line.comment;
  }
  std::smatch match;
  if (!std::regex_match(constant.code, match, kWhole)) return std::nullopt;
  constant.name = match[1];
  return constant;
}

bool is_number(const Constant& constant) {
  static const std::regex kType(
      R"(\b(int|long|short|unsigned|float|double|size_t|u?int\d+_t)\s+\w+(\[|\s*=|\{))");
  static const std::regex kLimit(R"(\bnumeric_limits<.*>::(infinity|quiet_NaN)\(\);)");
  if (std::regex_search(constant.code, kLimit)) return false;
  if (std::regex_search(constant.code, kType)) return true;
  static const std::regex kLiteral(R"(\b\d)");
  const std::size_t value = constant.code.find_first_of("={");
  return std::regex_search(constant.code.begin() + static_cast<std::ptrdiff_t>(value),
                           constant.code.end(), kLiteral);
}

/// Whether `text` is made of known units: "m", "m/s^2", "m, rad".
bool is_unit(const std::string& text) {
  static const std::regex kBetween(R"(\^-?\d|\s*[/,*]\s*)");
  std::sregex_token_iterator part(text.begin(), text.end(), kBetween, -1);
  return std::all_of(
      part, {}, [](const auto& unit) { return unit.length() == 0 || kUnits.contains(unit.str()); });
}

bool has_unit(const std::string& comment) {
  static const std::regex kBracket(R"(\[([^\[\]]+)\])");
  std::sregex_iterator bracket(comment.begin(), comment.end(), kBracket);
  return std::any_of(bracket, {}, [](const std::smatch& match) { return is_unit(match[1]); });
}

bool has_source(const std::string& comment) {
  static const std::regex kSource(R"(\bSource: +[^ ])");
  return std::regex_search(comment, kSource);
}

/// Empty where nothing is missing.
std::string missing(const Constant& constant) {
  if (is_blank(constant.comment)) return " has no comment";
  std::string parts;
  if (!has_unit(constant.comment)) parts += "unit";
  if (!has_source(constant.comment)) parts += parts.empty() ? "source" : ", source";
  return parts.empty() ? "" : " lacks " + parts;
}

}  // namespace

std::vector<std::string> constant_faults(const std::string& name, const std::string& source) {
  const std::vector<std::string> lines = lines_of(source);
  std::vector<std::string> faults;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::optional<Constant> constant = constant_at(lines, i);
    if (!constant || !is_number(*constant)) continue;
    const std::string fault = missing(*constant);
    if (!fault.empty()) {
      faults.push_back(name + ":" + std::to_string(i + 1) + ": " + constant->name + fault);
    }
  }
  return faults;
}

std::vector<std::string> constant_faults(const fs::path& root,
                                         std::span<const char* const> folders) {
  std::set<fs::path> files;
  for (const char* folder : folders) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const fs::path extension = entry.path().extension();
      if (extension == ".hpp" || extension == ".cpp") files.insert(entry.path());
    }
  }
  std::vector<std::string> faults;
  for (const fs::path& file : files) {
    std::ifstream stream(file);
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    const std::string name = fs::relative(file, root).generic_string();
    for (std::string& fault : constant_faults(name, text)) faults.push_back(std::move(fault));
  }
  return faults;
}

}  // namespace mms::testing
