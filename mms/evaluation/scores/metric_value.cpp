#include "mms/evaluation/scores/metric_value.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "mms/evaluation/scores/metric_json.hpp"

namespace mms {

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
  std::size_t name_width = 0;
  std::size_t number_width = 0;
  for (const MetricValue& item : values) {
    name_width = std::max(name_width, item.meaning.size());
    number_width = std::max(number_width, to_fixed(item.value, item.decimals).size());
  }
  std::string table;
  for (const MetricValue& item : values) {
    const std::size_t number = to_fixed(item.value, item.decimals).size();
    table += item.meaning + std::string(name_width - item.meaning.size() + 2, ' ');
    table += std::string(number_width - number, ' ') + with_unit(item) + "\n";
  }
  return table;
}

}  // namespace mms
