#include "mms/io/weights/safetensors_header.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "mms/core/error.hpp"
#include "mms/io/config/json_entry.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace {

using Json = nlohmann::json;

struct ElementFormat {
  std::string_view name;
  std::uint64_t bytes;
};

// In the order of ElementType.
constexpr std::array<ElementFormat, 7> kFormats = {
    {{"F32", 4}, {"F16", 2}, {"BF16", 2}, {"F64", 8}, {"I64", 8}, {"I32", 4}, {"I8", 1}}};

const ElementFormat& format_of(ElementType type) {
  return kFormats[static_cast<std::size_t>(type)];
}

/// Rejects what the parser would accept: duplicate keys, floating-point numbers, and deep nesting.
class StrictEvents {
 public:
  explicit StrictEvents(const std::string& where) : where_(where) {}

  bool operator()(int depth, Json::parse_event_t event, const Json& parsed) {
    if (event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start) {
      enter(depth);
    } else if (event == Json::parse_event_t::key) {
      add_key(depth, parsed.get_ref<const std::string&>());
    } else if (event == Json::parse_event_t::value && parsed.is_number_float()) {
      throw DataError(where_, "its header has the floating-point number " +
                                  format_number(parsed.get<double>()) +
                                  ", allowed: integers below 2^63");
    }
    return true;
  }

 private:
  /// Depth of header, tensor and list.
  static constexpr std::size_t kDepth = 3;

  void enter(int depth) {
    const auto level = static_cast<std::size_t>(depth);
    if (level >= kDepth) {
      throw DataError(where_,
                      "its header is nested more than " + std::to_string(kDepth) + " levels deep");
    }
    keys_[level].clear();
  }

  void add_key(int depth, const std::string& key) {
    if (keys_[static_cast<std::size_t>(depth - 1)].insert(key).second) return;
    throw DataError(where_, "its header has the name '" + key + "' twice");
  }

  const std::string& where_;
  std::array<std::set<std::string>, kDepth> keys_;
};

Json parse_strictly(std::string_view text, const std::string& where) {
  if (!text.starts_with('{')) {
    throw DataError(where, "its header does not begin with '{'", "is it a safetensors file?");
  }
  try {
    StrictEvents events(where);
    return Json::parse(text, [&](int depth, Json::parse_event_t event, const Json& parsed) {
      return events(depth, event, parsed);
    });
  } catch (const Json::exception& error) {
    const std::string what = error.what();  // "[json.exception...] parse error at line 1, ..."
    const std::size_t end = what.find("] ");
    throw DataError(where, "its header is not JSON: " +
                               (end == std::string::npos ? what : what.substr(end + 2)));
  }
}

ElementType type_of(const JsonEntry& entry) {
  const std::string name = entry.text();
  std::string allowed;
  for (std::size_t i = 0; i < kFormats.size(); ++i) {
    if (kFormats[i].name == name) return static_cast<ElementType>(i);
    allowed += (i == 0 ? "" : ", ") + std::string(kFormats[i].name);
  }
  entry.fail("is '" + name + "', allowed: " + allowed);
}

std::uint64_t size_of(const StoredTensor& tensor, const JsonEntry& shape) {
  std::uint64_t size = bytes_of(tensor.type);
  for (const std::int64_t side : tensor.shape) {
    if (__builtin_mul_overflow(size, static_cast<std::uint64_t>(side), &size)) {
      shape.fail("exceeds 64 bits");
    }
  }
  return size;
}

void read_place(const JsonEntry& offsets, std::uint64_t size, StoredTensor& tensor) {
  const std::vector<JsonEntry> pair = offsets.elements();
  if (pair.size() != 2) {
    offsets.fail("has " + std::to_string(pair.size()) +
                 " numbers, expected the first and last byte");
  }
  tensor.begin = static_cast<std::uint64_t>(pair[0].integer({0}));
  tensor.end = static_cast<std::uint64_t>(pair[1].integer({0}));
  if (tensor.end < tensor.begin) {
    offsets.fail("end at byte " + std::to_string(tensor.end) + ", before its begin at byte " +
                 std::to_string(tensor.begin));
  }
  if (tensor.end - tensor.begin != size) {
    offsets.fail("have " + std::to_string(tensor.end - tensor.begin) +
                 " bytes, expected from shape and dtype: " + std::to_string(size));
  }
}

StoredTensor read_tensor(const std::string& name, const Json& json, const std::string& where) {
  const JsonEntry entry(json, where, name);
  StoredTensor tensor;
  tensor.name = name;
  tensor.type = type_of(entry.at("dtype"));
  const JsonEntry shape = entry.at("shape");
  for (const JsonEntry& side : shape.elements()) tensor.shape.push_back(side.integer({0}));
  read_place(entry.at("data_offsets"), size_of(tensor, shape), tensor);
  for (const auto& [key, value] : json.items()) {
    if (key == "dtype" || key == "shape" || key == "data_offsets") continue;
    entry.fail("has the unknown key '" + key + "', allowed: dtype, shape, data_offsets");
  }
  return tensor;
}

std::map<std::string, std::string> read_metadata(const Json& json, const std::string& where) {
  const std::string key(kSafetensorsMetadata);
  if (!json.is_object()) JsonEntry(json, where, key).fail("is not an object of strings");
  std::map<std::string, std::string> metadata;
  for (const auto& [name, text] : json.items()) {
    metadata[name] = JsonEntry(text, where, key + "." + name).text();
  }
  return metadata;
}

void check_no_gaps(const std::vector<StoredTensor>& tensors, const std::string& where) {
  std::uint64_t end = 0;
  for (const StoredTensor& tensor : tensors) {
    if (tensor.begin < end) {
      throw DataError(where,
                      "tensor '" + tensor.name + "' begins at byte " +
                          std::to_string(tensor.begin) + " of the data, but byte " +
                          std::to_string(end) + " is the first free one",
                      "tensors must not overlap");
    }
    if (tensor.begin > end) {
      throw DataError(where, std::to_string(tensor.begin - end) + " unused bytes of data before '" +
                                 tensor.name + "'");
    }
    end = tensor.end;
  }
}

}  // namespace

std::uint64_t bytes_of(ElementType type) {
  return format_of(type).bytes;
}

void fail_value(const std::string& where, const std::string& tensor, std::size_t index,
                double value, double largest) {
  throw DataError(where, "tensor '" + tensor + "': value " + std::to_string(index) + " is " +
                             format_number(value) + ", allowed: " + format_number(-largest) +
                             " to " + format_number(largest));
}

SafetensorsHeader parse_safetensors_header(std::string_view json, const std::string& where) {
  const Json root = parse_strictly(json, where);
  SafetensorsHeader header;
  for (const auto& [name, value] : root.items()) {
    if (name == kSafetensorsMetadata) {
      header.metadata = read_metadata(value, where);
    } else {
      header.tensors.push_back(read_tensor(name, value, where));
    }
  }
  const auto place = [](const StoredTensor& t) { return std::pair(t.begin, t.end); };
  std::ranges::stable_sort(header.tensors, {}, place);
  check_no_gaps(header.tensors, where);
  return header;
}

}  // namespace mms
