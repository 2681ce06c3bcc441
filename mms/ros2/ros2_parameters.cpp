#include "mms/ros2/ros2_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "mms/core/error.hpp"

namespace mms {
namespace {

using msg::ParameterValue;

constexpr std::size_t kMaxNames = 10'000;  // in a request: bounds the reply

/// @throws DataError for a request of too many parameters
void check_count(std::size_t names) {
  if (names <= kMaxNames) return;
  throw DataError("a request", "has " + std::to_string(names) +
                                   " parameters, allowed: " + std::to_string(kMaxNames));
}

/// Collects the fields of settings.
class ParameterCollector final : public ConfigVisitor {
 public:
  std::vector<Ros2Parameter> take() { return std::move(parameters_); }

  void number(const FieldInfo& info, double& value, Range range) override {
    constexpr double kLargest = std::numeric_limits<double>::max();
    Ros2Parameter& added = add(info, ParameterValue::kDouble);
    added.value.double_value = value;
    added.descriptor.floating_point_range = {{.from_value = std::max(range.min, -kLargest),
                                              .to_value = std::min(range.max, kLargest),
                                              .step = 0.0}};
  }
  void integer(const FieldInfo& info, int& value, Range range) override {
    constexpr int kLargest = std::numeric_limits<int>::max();
    Ros2Parameter& added = add(info, ParameterValue::kInteger);
    added.value.integer_value = value;
    const auto bound = [](double limit) {
      return static_cast<std::int64_t>(
          std::clamp(limit, -static_cast<double>(kLargest), static_cast<double>(kLargest)));
    };
    added.descriptor.integer_range = {
        {.from_value = bound(range.min), .to_value = bound(range.max), .step = 0}};
  }
  void boolean(const FieldInfo& info, bool& value) override {
    add(info, ParameterValue::kBool).value.bool_value = value;
  }
  void choice(const FieldInfo& info, int& index,
              std::span<const std::string_view> choices) override {
    Ros2Parameter& added = add(info, ParameterValue::kString);
    added.value.string_value = choices[static_cast<std::size_t>(index)];
    std::string& allowed = added.descriptor.additional_constraints;
    for (const std::string_view word : choices) {
      allowed += (allowed.empty() ? "one of " : ", ") + std::string(word);
    }
  }
  void text(const FieldInfo& info, std::string& value) override {
    add(info, ParameterValue::kString).value.string_value = value;
  }

 private:
  void begin_group(const FieldInfo& info) override {
    ends_.push_back(prefix_.size());
    prefix_ += std::string(info.key) + ".";
  }
  void end_group() override {
    prefix_.resize(ends_.back());
    ends_.pop_back();
  }
  std::size_t begin_list(const FieldInfo&, std::size_t) override { return 0; }

  Ros2Parameter& add(const FieldInfo& info, ParameterValue::Type type) {
    Ros2Parameter& added = parameters_.emplace_back();
    added.value.type = added.descriptor.type = type;
    added.descriptor.name = prefix_ + std::string(info.key);
    added.descriptor.description = info.doc;
    if (!info.unit.empty()) added.descriptor.description += " [" + std::string(info.unit) + "]";
    return added;
  }

  std::vector<Ros2Parameter> parameters_;
  std::string prefix_;
  std::vector<std::size_t> ends_;  ///< of the prefixes of the groups outside
};

bool is_within(std::string_view name, std::uint64_t depth) {
  return depth == 0 || static_cast<std::uint64_t>(std::ranges::count(name, '.')) < depth;
}

bool is_selected(std::string_view name, const msg::ListParametersRequest& request) {
  if (request.prefixes.empty()) return is_within(name, request.depth);
  return std::ranges::any_of(request.prefixes, [&](const std::string& prefix) {
    if (name == prefix) return true;
    return name.starts_with(prefix + ".") &&
           is_within(name.substr(prefix.size() + 1), request.depth);
  });
}

/// The parameter of a name; one that is not set if there is none.
Ros2Parameter find(const std::vector<Ros2Parameter>& parameters, const std::string& name) {
  const auto found = std::ranges::find_if(
      parameters, [&](const Ros2Parameter& known) { return known.descriptor.name == name; });
  if (found != parameters.end()) return *found;
  Ros2Parameter unknown;
  unknown.descriptor.name = name;
  return unknown;
}

}  // namespace

std::vector<Ros2Parameter> parameters_of(SystemConfig config) {
  ParameterCollector collector;
  config.visit(collector);
  return collector.take();
}

msg::ListParametersReply list_parameters(const std::vector<Ros2Parameter>& parameters,
                                         const msg::ListParametersRequest& request) {
  msg::ListParametersReply reply;
  std::set<std::string> prefixes;
  for (const Ros2Parameter& parameter : parameters) {
    const std::string& name = parameter.descriptor.name;
    if (!is_selected(name, request)) continue;
    reply.names.push_back(name);
    const std::size_t dot = name.rfind('.');
    if (dot != std::string::npos) prefixes.insert(name.substr(0, dot));
  }
  reply.prefixes.assign(prefixes.begin(), prefixes.end());
  return reply;
}

void offer_parameters(Ros2Node& node, const SystemConfig& config) {
  using msg::ListOf;
  using msg::ParameterNames;
  const auto all = std::make_shared<const std::vector<Ros2Parameter>>(parameters_of(config));
  const auto each = [all](const ParameterNames& request, auto& list, const auto& part) {
    check_count(request.names.size());
    for (const std::string& name : request.names) list.items.push_back(part(find(*all, name)));
    return list;
  };
  const msg::SetParametersResult refusal{
      false, "settings cannot be changed: start mms ros2 again with --set NAME=VALUE"};
  node.answer<msg::ListParametersRequest, msg::ListParametersReply>(
      "~/list_parameters", "rcl_interfaces/ListParameters",
      [all](const msg::ListParametersRequest& request) { return list_parameters(*all, request); });
  node.answer<ParameterNames, ListOf<ParameterValue>>(
      "~/get_parameters", "rcl_interfaces/GetParameters", [each](const ParameterNames& request) {
        ListOf<ParameterValue> values;
        return each(request, values, [](const Ros2Parameter& found) { return found.value; });
      });
  node.answer<ParameterNames, ListOf<std::uint8_t>>(
      "~/get_parameter_types", "rcl_interfaces/GetParameterTypes",
      [each](const ParameterNames& request) {
        ListOf<std::uint8_t> types;
        return each(request, types, [](const Ros2Parameter& found) { return found.value.type; });
      });
  node.answer<ParameterNames, ListOf<msg::ParameterDescriptor>>(
      "~/describe_parameters", "rcl_interfaces/DescribeParameters",
      [each](const ParameterNames& request) {
        ListOf<msg::ParameterDescriptor> descriptors;
        return each(request, descriptors,
                    [](const Ros2Parameter& found) { return found.descriptor; });
      });
  node.answer<ListOf<msg::Parameter>, ListOf<msg::SetParametersResult>>(
      "~/set_parameters", "rcl_interfaces/SetParameters",
      [refusal](const ListOf<msg::Parameter>& request) {
        check_count(request.items.size());
        return ListOf<msg::SetParametersResult>{
            std::vector<msg::SetParametersResult>(request.items.size(), refusal)};
      });
  node.answer<ListOf<msg::Parameter>, msg::SetParametersResult>(
      "~/set_parameters_atomically", "rcl_interfaces/SetParametersAtomically",
      [refusal](const ListOf<msg::Parameter>&) { return refusal; });
}

}  // namespace mms
