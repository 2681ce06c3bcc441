#include "mms/segmentation/weights/model.hpp"

#include <charconv>
#include <sstream>

#include "mms/core/error.hpp"
#include "mms/segmentation/weights/int8_weights.hpp"

namespace mms {
namespace {

constexpr const char* kClasses = "classes";

/// Visits a config's fields with their full paths: "network.head.norm".
class PathVisitor : public ConfigVisitor {
 protected:
  void begin_group(const FieldInfo& info) override { groups_.push_back(path(info) + "."); }
  void end_group() override { groups_.pop_back(); }

  std::string path(const FieldInfo& info) const { return groups_.back() + std::string(info.key); }

 private:
  std::vector<std::string> groups_ = {"network."};
};

class MetadataWriter final : public PathVisitor {
 public:
  explicit MetadataWriter(std::map<std::string, std::string>& metadata) : metadata_(metadata) {}

  void number(const FieldInfo& info, double& value, Range) override {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.begin(), text.end(), value).ptr;
    metadata_[path(info)] = std::string(text.begin(), end);
  }
  void integer(const FieldInfo& info, int& value, Range) override {
    metadata_[path(info)] = std::to_string(value);
  }
  void boolean(const FieldInfo& info, bool& value) override {
    metadata_[path(info)] = value ? "true" : "false";
  }
  void choice(const FieldInfo& info, int& index,
              std::span<const std::string_view> choices) override {
    metadata_[path(info)] = std::string(choices[static_cast<std::size_t>(index)]);
  }
  void text(const FieldInfo& info, std::string& value) override { metadata_[path(info)] = value; }

 private:
  std::map<std::string, std::string>& metadata_;
};

/// Files from before these existed lack them: their networks have neither.
constexpr std::array<std::string_view, 2> kLaterSettings = {"network.head.level_norms",
                                                            "network.head.window"};

class MetadataReader final : public PathVisitor {
 public:
  MetadataReader(const std::map<std::string, std::string>& metadata, const std::string& where)
      : metadata_(metadata), where_(where) {}

  void number(const FieldInfo& info, double& value, Range range) override {
    parse(info, value, range, "a number");
  }
  void integer(const FieldInfo& info, int& value, Range range) override {
    parse(info, value, range, "an integer");
  }
  void boolean(const FieldInfo& info, bool& value) override {
    const std::string name = path(info);
    const bool is_later =
        std::find(kLaterSettings.begin(), kLaterSettings.end(), name) != kLaterSettings.end();
    if (is_later && !metadata_.contains(name)) return;
    constexpr std::array<std::string_view, 2> kWords = {"false", "true"};
    int index = 0;
    choice(info, index, kWords);
    value = index == 1;
  }
  void choice(const FieldInfo& info, int& index,
              std::span<const std::string_view> choices) override {
    const std::string& word = find(info);
    for (std::size_t i = 0; i < choices.size(); ++i) {
      if (choices[i] != word) continue;
      index = static_cast<int>(i);
      return;
    }
    std::string allowed;
    for (const std::string_view known : choices) {
      allowed += (allowed.empty() ? "" : ", ") + std::string(known);
    }
    fail(info, word, "one of " + allowed);
  }
  void text(const FieldInfo& info, std::string& value) override { value = find(info); }

 private:
  const std::string& find(const FieldInfo& info) const {
    const auto found = metadata_.find(path(info));
    if (found == metadata_.end()) {
      throw DataError(where_, "does not describe its network: missing '" + path(info) + "'",
                      "convert weights of other programs with mms import");
    }
    return found->second;
  }

  template <class Number>
  void parse(const FieldInfo& info, Number& value, Range range, const std::string& expected) const {
    const std::string& text = find(info);
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = fault == std::errc() && end == text.data() + text.size();
    const auto number = static_cast<double>(value);
    if (whole && number >= range.min && number <= range.max) return;
    std::ostringstream allowed;
    allowed << expected << " in [" << range.min << ", " << range.max << "]";
    fail(info, text, allowed.str());
  }

  [[noreturn]] void fail(const FieldInfo& info, const std::string& value,
                         const std::string& allowed) const {
    throw DataError(where_, path(info) + " is '" + value + "', expected " + allowed);
  }

  const std::map<std::string, std::string>& metadata_;
  const std::string& where_;
};

std::vector<std::string> split_names(const std::string& text) {
  std::vector<std::string> names;
  std::istringstream stream(text);
  for (std::string name; std::getline(stream, name, ',');) names.push_back(name);
  return names;
}

}  // namespace

Weights pack_model(SegmentationModel model) {
  Weights packed = std::move(model.weights);
  MetadataWriter writer(packed.metadata);
  model.network.visit(writer);
  std::string names;
  for (const std::string& name : model.classes) names += (names.empty() ? "" : ",") + name;
  packed.metadata[kClasses] = names;
  return packed;
}

SegmentationModel unpack_model(Weights weights, const std::string& where) {
  SegmentationModel model;
  MetadataReader reader(weights.metadata, where);
  model.network.visit(reader);
  const auto classes = weights.metadata.find(kClasses);
  if (classes != weights.metadata.end()) model.classes = split_names(classes->second);
  if (static_cast<int>(model.classes.size()) != model.network.classes) {
    throw DataError(where, "names " + std::to_string(model.classes.size()) +
                               " classes, but its network has " +
                               std::to_string(model.network.classes));
  }
  model.weights = from_bytes(std::move(weights), where);
  return model;
}

}  // namespace mms
