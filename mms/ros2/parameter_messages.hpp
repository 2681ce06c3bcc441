#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mms::msg {

// Requests and replies of the services of rcl_interfaces by which `ros2 param` reads a node.

/// Value of a parameter.
struct ParameterValue {
  enum Type : std::uint8_t { kNotSet = 0, kBool = 1, kInteger = 2, kDouble = 3, kString = 4 };

  std::uint8_t type = kNotSet;
  bool bool_value = false;
  std::int64_t integer_value = 0;
  double double_value = 0.0;
  std::string string_value{};
  std::vector<std::uint8_t> byte_array_value{};
  std::vector<std::uint8_t> bool_array_value{};
  std::vector<std::int64_t> integer_array_value{};
  std::vector<double> double_array_value{};
  std::vector<std::string> string_array_value{};

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {  ///< see wire.hpp
    archive(self.type, self.bool_value, self.integer_value, self.double_value, self.string_value,
            self.byte_array_value, self.bool_array_value, self.integer_array_value,
            self.double_array_value, self.string_array_value);
  }
};

/// Allowed values of a number; `step` is 0.
template <class Number, class Step>
struct ParameterRange {
  Number from_value{};
  Number to_value{};
  Step step{};

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {  ///< see wire.hpp
    archive(self.from_value, self.to_value, self.step);
  }
};

/// What a parameter means.
struct ParameterDescriptor {
  std::string name{};
  std::uint8_t type = ParameterValue::kNotSet;
  std::string description{};
  std::string additional_constraints{};
  bool read_only = true;
  bool dynamic_typing = false;
  std::vector<ParameterRange<double, double>> floating_point_range{};        ///< one or none
  std::vector<ParameterRange<std::int64_t, std::uint64_t>> integer_range{};  ///< one or none

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {  ///< see wire.hpp
    archive(self.name, self.type, self.description, self.additional_constraints, self.read_only,
            self.dynamic_typing, self.floating_point_range, self.integer_range);
  }
};

/// A parameter with its value.
struct Parameter {
  std::string name{};
  ParameterValue value{};

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {  ///< see wire.hpp
    archive(self.name, self.value);
  }
};

/// Request of ListParameters.
struct ListParametersRequest {
  std::vector<std::string> prefixes{};  ///< empty: all parameters
  std::uint64_t depth = 0;              ///< of names, by their dots; 0: any

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {  ///< see wire.hpp
    archive(self.prefixes, self.depth);
  }
};

/// Reply of ListParameters.
struct ListParametersReply {
  std::vector<std::string> names{};
  std::vector<std::string> prefixes{};  ///< of the names

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {  ///< see wire.hpp
    archive(self.names, self.prefixes);
  }
};

/// Request of GetParameters, GetParameterTypes and DescribeParameters.
struct ParameterNames {
  std::vector<std::string> names{};

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {  ///< see wire.hpp
    archive(self.names);
  }
};

/// A message of one list.
template <class Item>
struct ListOf {
  std::vector<Item> items{};

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {  ///< see wire.hpp
    archive(self.items);
  }
};

/// Result of setting parameters.
struct SetParametersResult {
  bool successful = false;
  std::string reason{};

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {  ///< see wire.hpp
    archive(self.successful, self.reason);
  }
};

}  // namespace mms::msg
