#include "mms/evaluation/scores/metric_value.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "mms/evaluation/scores/metric_json.hpp"

namespace mms {
namespace {

/// Columns of a table in characters.
struct Widths {
  std::size_t name = 0;
  std::size_t number = 0;

  void fit(std::span<const MetricValue> values) {
    for (const MetricValue& item : values) {
      name = std::max(name, item.meaning.size());
      number = std::max(number, to_fixed(item.value, item.decimals).size());
    }
  }
};

std::string lines_of(std::span<const MetricValue> values, const Widths& widths,
                     const std::string& indent) {
  std::string lines;
  for (const MetricValue& item : values) {
    const std::size_t number = to_fixed(item.value, item.decimals).size();
    lines += indent + item.meaning + std::string(widths.name - item.meaning.size() + 2, ' ');
    lines += std::string(widths.number - number, ' ') + with_unit(item) + "\n";
  }
  return lines;
}

}  // namespace

std::string to_fixed(double value, int decimals) {
  if (!std::isfinite(value)) return "n/a";
  const int length = std::snprintf(nullptr, 0, "%.*f", decimals, value);
  std::string text(static_cast<std::size_t>(length), '\0');
  std::snprintf(text.data(), text.size() + 1, "%.*f", decimals, value);
  return text;
}

std::string with_unit(const MetricValue& item) {
  const std::string number = to_fixed(item.value, item.decimals);
  return item.unit.empty() || !std::isfinite(item.value) ? number : number + " " + item.unit;
}

nlohmann::ordered_json json_object(std::span<const MetricValue> values) {
  nlohmann::ordered_json object = nlohmann::ordered_json::object();
  for (const MetricValue& item : values) {
    if (item.decimals == 0 && std::isfinite(item.value)) {
      object[item.key] = static_cast<std::int64_t>(std::llround(item.value));
    } else {
      object[item.key] = item.value;
    }
  }
  return object;
}

std::string to_json(std::span<const MetricValue> values) {
  return json_object(values).dump();
}

std::string to_table(std::span<const MetricValue> values) {
  Widths widths;
  widths.fit(values);
  return lines_of(values, widths, "");
}

std::string to_table(std::span<const MetricSection> sections) {
  Widths widths;
  for (const MetricSection& section : sections) widths.fit(section.values);
  std::string table;
  for (const MetricSection& section : sections) {
    table += section.title + (section.rating.empty() ? "" : ": " + section.rating) + "\n" +
             lines_of(section.values, widths, "  ");
  }
  return table;
}

}  // namespace mms
