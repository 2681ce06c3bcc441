#include "mms/dataset/simulated_source.hpp"

#include <algorithm>
#include <map>
#include <string>

#include "mms/core/error.hpp"
#include "mms/io/numbers.hpp"
#include "mms/simulation/simulated_room.hpp"

namespace mms {
namespace {

constexpr std::string_view kScheme = "sim:";

/// Sets the fields of a config from the "key=value" parts of an address.
class QueryFields : public ConfigVisitor {
 public:
  QueryFields(std::string_view address, std::string_view query) : address_(address) {
    while (!query.empty()) {
      const std::string_view part = query.substr(0, query.find('&'));
      query.remove_prefix(std::min(query.size(), part.size() + 1));
      const std::size_t equals = part.find('=');
      if (equals == std::string_view::npos) fail(std::string(part) + " is not key=value");
      values_.emplace(part.substr(0, equals), part.substr(equals + 1));
    }
  }

  void number(const FieldInfo& info, double& value, Range range) override {
    const std::optional<std::string> text = take(info);
    if (!text) return;
    const std::optional<double> parsed = parse_double(*text);
    check(info, *text, range, parsed);
    value = *parsed;
  }

  void integer(const FieldInfo& info, int& value, Range range) override {
    const std::optional<std::string> text = take(info);
    if (!text) return;
    const std::optional<std::int64_t> parsed = parse_integer(*text);
    check(info, *text, range, parsed);
    value = static_cast<int>(*parsed);
  }

  void boolean(const FieldInfo& info, bool& value) override {
    const std::optional<std::string> text = take(info);
    if (!text) return;
    value = *text == "true" || *text == "1";
    if (!value && *text != "false" && *text != "0") {
      fail(std::string(info.key) + " is '" + *text + "', allowed are true and false");
    }
  }

  void choice(const FieldInfo& info, int& index,
              std::span<const std::string_view> choices) override {
    const std::optional<std::string> text = take(info);
    if (!text) return;
    const auto found = std::find(choices.begin(), choices.end(), *text);
    if (found == choices.end()) fail(std::string(info.key) + " cannot be '" + *text + "'");
    index = static_cast<int>(found - choices.begin());
  }

  /// To be called after the visit: no part may be left that no field took.
  void finish() const {
    if (!values_.empty())
      fail("unknown key '" + values_.begin()->first + "'", "keys are " + known_);
  }

 protected:
  void begin_group(const FieldInfo&) override {}
  void end_group() override {}

 private:
  std::optional<std::string> take(const FieldInfo& info) {
    if (!known_.empty()) known_ += ", ";
    known_ += info.key;
    const auto found = values_.find(std::string(info.key));
    if (found == values_.end()) return std::nullopt;
    std::string text = found->second;
    values_.erase(found);
    return text;
  }

  template <class Number>
  void check(const FieldInfo& info, const std::string& text, Range range,
             std::optional<Number> value) const {
    if (value && static_cast<double>(*value) >= range.min &&
        static_cast<double>(*value) <= range.max) {
      return;
    }
    fail(std::string(info.key) + " is '" + text + "', allowed is " + format_number(range.min) +
         " to " + format_number(range.max));
  }

  [[noreturn]] void fail(const std::string& what, const std::string& hint = "") const {
    throw DataError(address_, what, hint);
  }

  std::string address_;
  std::map<std::string, std::string> values_;
  std::string known_;
};

RoomConfig room_config(std::string_view address) {
  const std::string_view body = address.substr(kScheme.size());
  const std::size_t mark = std::min(body.find('?'), body.size());
  if (body.substr(0, mark) != "room") {
    throw DataError(std::string(address), "no such scene", "the scene there is: sim:room");
  }
  RoomConfig config;
  QueryFields fields(address, body.substr(std::min(body.size(), mark + 1)));
  config.visit(fields);
  fields.finish();
  return config;
}

class SimulatedSource : public FrameSource {
 public:
  SimulatedSource(const RoomConfig& config, bool load_masks)
      : room_(config), load_masks_(load_masks) {
    for (int i = 0; i < room_.size(); ++i) truth_.push_back(room_.truth(i));
  }

  std::optional<Frame> next() override {
    if (position_ >= size()) return std::nullopt;
    Frame frame = room_.render(static_cast<int>(position_++));
    if (!load_masks_) frame.mask = {};
    return frame;
  }

  std::size_t size() const override { return static_cast<std::size_t>(room_.size()); }
  std::size_t skipped() const override { return 0; }
  bool has_masks() const override { return load_masks_; }
  void skip(std::size_t count) override { position_ += std::min(count, size() - position_); }
  const Trajectory& ground_truth() const override { return truth_; }
  void on_warning(WarningHandler) override {}

  std::vector<std::string> describe() const override {
    const RoomConfig& config = room_.config();
    return {"format: simulated room, seed " + std::to_string(config.seed),
            "frames: " + std::to_string(config.frames) + " at " + format_number(config.hz) + " Hz",
            "image: " + std::to_string(config.width) + " x " + std::to_string(config.height) +
                " with depth",
            "moving objects: " + std::to_string(room_.objects(0).size()),
            load_masks_ ? "masks: exact" : "masks: none",
            "truth: exact"};
  }

 private:
  SimulatedRoom room_;
  bool load_masks_;
  Trajectory truth_;
  std::size_t position_ = 0;
};

}  // namespace

bool is_simulated(std::string_view address) {
  return address.starts_with(kScheme);
}

std::unique_ptr<FrameSource> open_simulated(std::string_view address,
                                            const SourceOptions& options) {
  if (!is_simulated(address)) throw DataError(std::string(address), "is no simulation");
  if (!options.masks.empty()) {
    throw DataError(std::string(address), "cannot take masks from " + options.masks.string(),
                    "a simulation brings its own exact masks");
  }
  return std::make_unique<SimulatedSource>(room_config(address), options.load_masks);
}

}  // namespace mms
