#pragma once

#include <span>
#include <string>
#include <vector>

namespace mms {

/// One result for JSON, tables and report.
struct MetricValue {
  std::string key;      ///< name in the JSON
  std::string meaning;  ///< name in tables
  double value = 0.0;   ///< in `unit`; NaN if undefined
  std::string unit;     ///< "m", "deg", "%", ...; empty for counts and ratios
  int decimals = 3;     ///< decimals in tables; 0 marks a count, an integer in the JSON
};

/// Results with a common title.
struct MetricSection {
  std::string title;
  std::string rating;  ///< "good", "fair" or "poor"; empty without ground truth
  std::vector<MetricValue> values;
};

/// `value` with `decimals` places; "n/a" for NaN and infinities.
std::string to_fixed(double value, int decimals);

/// The value with its unit, as in "0.012 m"; "n/a" if undefined.
std::string with_unit(const MetricValue& item);

/// One JSON object; keys in the given order, numbers in full precision, null for NaN.
std::string to_json(std::span<const MetricValue> values);

/// Lines "meaning  value unit", columns aligned, each ended by a newline.
std::string to_table(std::span<const MetricValue> values);

/// Title and rating of each section, and its lines as above, indented; columns aligned over all
/// sections.
std::string to_table(std::span<const MetricSection> sections);

}  // namespace mms
