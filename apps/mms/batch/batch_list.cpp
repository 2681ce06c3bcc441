#include "apps/mms/batch/batch_list.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace {

constexpr std::size_t kMaxShards = 100'000;
constexpr std::size_t kLongestName = 120;  // characters; file systems allow 255

/// Those that the batch sets itself, or that make no sense in it.
constexpr std::array<std::string_view, 8> kOwnOptions = {
    "-o", "--output", "--overwrite", "--view", "--bind", "-q", "--quiet", "--json"};

/// Splits a line into words, up to a comment; nothing for an open quote.
std::optional<std::vector<std::string>> words_of(const std::string& line) {
  std::vector<std::string> words;
  bool in_word = false;
  char quote = '\0';
  for (const char c : line) {
    if (quote != '\0') {
      if (c == quote) {
        quote = '\0';
      } else {
        words.back() += c;
      }
      continue;
    }
    if (std::isspace(static_cast<unsigned char>(c)) != 0) {
      in_word = false;
      continue;
    }
    if (c == '#' && !in_word) break;
    if (!in_word) words.emplace_back();
    in_word = true;
    if (c == '"' || c == '\'') {
      quote = c;
    } else {
      words.back() += c;
    }
  }
  if (quote != '\0') return std::nullopt;
  return words;
}

/// The words with what does not belong in the name of a file as underscores. Of long ones the
/// end, and a number that tells them apart.
std::string name_of(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : " ") + word;
  std::string name;
  for (const char c : all) {
    const bool is_plain =
        std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.' || c == '=';
    if (is_plain) {
      name += c;
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  name.erase(0, name.find_first_not_of("._-"));
  if (name.size() <= kLongestName) return name;
  std::uint32_t hash = 2166136261U;  // FNV-1a
  for (const char c : all) hash = (hash ^ static_cast<std::uint8_t>(c)) * 16777619U;
  return fmt::format("{:08x}_{}", hash, name.substr(name.size() - kLongestName));
}

/// A run of the words of a line: [NAME =] DATA [OPTIONS].
BatchRun run_of(std::vector<std::string> words, const std::string& where) {
  BatchRun run;
  if (words.size() >= 2 && words[1] == "=") {
    run.name = words[0];
    if (run.name != name_of({run.name})) {
      throw DataError(where, "has the name '" + run.name + "'",
                      "allowed: letters, digits, '_', '-', '.', '=', with a letter or digit first");
    }
    words.erase(words.begin(), words.begin() + 2);
    if (words.empty()) throw DataError(where, "has a name without a recording");
  } else {
    run.name = name_of(words);
    if (run.name.empty()) throw DataError(where, "has no letters or digits");
  }
  run.words = std::move(words);
  return run;
}

}  // namespace

std::vector<BatchRun> read_batch_list(const std::filesystem::path& list) {
  std::vector<BatchRun> runs;
  std::map<std::string, std::size_t> lines;  // by name
  std::size_t number = 0;
  std::istringstream text(read_file(list));
  for (std::string line; std::getline(text, line);) {
    const std::string where = fmt::format("{}:{}", list.string(), ++number);
    const auto words = words_of(line);
    if (!words) throw DataError(where, "has a quote without end");
    if (words->empty()) continue;
    for (const std::string& word : *words) {
      const bool is_short = word.starts_with('-') && !word.starts_with("--");  // -oDIR is one word
      const std::string option = is_short ? word.substr(0, 2) : word.substr(0, word.find('='));
      if (std::find(kOwnOptions.begin(), kOwnOptions.end(), option) == kOwnOptions.end()) continue;
      throw DataError(where, "has the option " + option, "results are below -o of mms batch");
    }
    BatchRun run = run_of(*words, where);
    const auto [first, is_new] = lines.emplace(run.name, number);
    if (!is_new) {
      throw DataError(where,
                      fmt::format("has the same name as line {}: {}", first->second, run.name));
    }
    runs.push_back(std::move(run));
  }
  if (runs.empty()) throw DataError(list.string(), "has no runs", "one a line: DATA [OPTIONS]");
  return runs;
}

Shard parse_shard(const std::string& text) {
  const std::size_t slash = text.find('/');
  const auto index = parse_integer(text.substr(0, slash));
  const auto count =
      slash == std::string::npos ? std::nullopt : parse_integer(text.substr(slash + 1));
  const bool is_valid = index && count && *index >= 1 && *index <= *count &&
                        *count <= static_cast<std::int64_t>(kMaxShards);
  if (!is_valid) {
    throw DataError("--shard", fmt::format("is {}, expected i/n with i from 1 to n, as 2/5", text));
  }
  return {static_cast<std::size_t>(*index) - 1, static_cast<std::size_t>(*count)};
}

}  // namespace mms
