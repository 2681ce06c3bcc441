#include "mms/ros/type_hash.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <vector>

namespace mms::msg {
namespace {

using Lines = std::vector<std::string>;
using Definitions = std::map<std::string, Lines, std::less<>>;  ///< by "pkg/msg/Name"

/// Identifiers of type_description_interfaces/msg/FieldType.
const std::map<std::string, int, std::less<>> kFieldTypes = {
    {"int8", 2},   {"uint8", 3}, {"int16", 4},  {"uint16", 5},   {"int32", 6},
    {"uint32", 7}, {"int64", 8}, {"uint64", 9}, {"float32", 10}, {"float64", 11},
    {"char", 13},  {"bool", 15}, {"byte", 16},  {"string", 17}};
constexpr int kNestedType = 1;
constexpr int kBoundedString = 21;
constexpr int kArray = 48;  ///< added to the type of the items
constexpr int kBoundedSequence = 96;
constexpr int kUnboundedSequence = 144;

struct HashedField {
  std::string name;
  int type = 0;
  std::string capacity = "0";
  std::string string_capacity = "0";
  std::string nested;  ///< "pkg/msg/Name"; empty for others
};

[[noreturn]] void fail_line(const std::string& line) {
  throw std::invalid_argument("no field of a message: '" + line + "'");
}

/// "pkg/msg/Name" of "pkg/Name", or of "Name" in the package of `user`.
std::string full_name(const std::string& name, const std::string& user) {
  const std::size_t slash = name.find('/');
  if (slash == std::string::npos) return user.substr(0, user.find('/')) + "/msg/" + name;
  if (name.find('/', slash + 1) != std::string::npos) return name;
  return name.substr(0, slash) + "/msg" + name.substr(slash);
}

/// Removes "[]", "[4]" or "[<=4]" from the end of a type.
void take_list(std::string& type, HashedField& field) {
  if (!type.ends_with(']')) return;
  const std::size_t open = type.rfind('[');
  if (open == std::string::npos) fail_line(type);
  std::string size = type.substr(open + 1, type.size() - open - 2);
  type.resize(open);
  if (size.empty()) {
    field.type = kUnboundedSequence;
  } else if (size.starts_with("<=")) {
    field.type = kBoundedSequence;
    field.capacity = size.substr(2);
  } else {
    field.type = kArray;
    field.capacity = size;
  }
}

HashedField parse_field(const std::string& line, const std::string& user) {
  const std::size_t space = line.find(' ');
  if (space == std::string::npos) fail_line(line);
  std::string type = line.substr(0, space);
  HashedField field;
  field.name = line.substr(space + 1);
  take_list(type, field);
  if (type.starts_with("string<=")) {
    field.string_capacity = type.substr(8);
    field.type += kBoundedString;
  } else if (const auto found = kFieldTypes.find(type); found != kFieldTypes.end()) {
    field.type += found->second;
  } else {
    field.type += kNestedType;
    field.nested = full_name(type, user);
  }
  return field;
}

Definitions split_definition(std::string_view name, std::string_view definition) {
  Definitions all;
  Lines* lines = &all[std::string(name)];
  while (!definition.empty()) {
    const std::size_t end = std::min(definition.find('\n'), definition.size());
    const std::string line(definition.substr(0, end));
    definition.remove_prefix(std::min(end + 1, definition.size()));
    if (line.starts_with("MSG: ")) {
      lines = &all[full_name(line.substr(5), line.substr(5))];
      lines->clear();
      continue;
    }
    const bool constant = line.find('=') != std::string::npos && !line.starts_with("string<=");
    if (!line.empty() && !constant) lines->push_back(line);
  }
  return all;
}

std::string json_of(const HashedField& field) {
  return R"({"name": ")" + field.name + R"(", "type": {"type_id": )" + std::to_string(field.type) +
         R"(, "capacity": )" + field.capacity + R"(, "string_capacity": )" + field.string_capacity +
         R"(, "nested_type_name": ")" + field.nested + R"("}})";
}

/// Description of one type; adds those of its nested types to `used`.
void describe(const std::string& name, const Definitions& all,
              std::map<std::string, std::string>& used) {
  if (!used.emplace(name, "").second) return;
  const auto found = all.find(name);
  if (found == all.end()) throw std::invalid_argument("no definition of " + name);
  std::string fields;
  for (const std::string& line : found->second) {
    const HashedField field = parse_field(line, name);
    fields += (fields.empty() ? "" : ", ") + json_of(field);
    if (!field.nested.empty()) describe(field.nested, all, used);
  }
  used[name] = R"({"type_name": ")" + name + R"(", "fields": [)" + fields + "]}";
}

constexpr std::array<std::uint32_t, 64> kSha256 = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

using Sha256State = std::array<std::uint32_t, 8>;

void add_block(Sha256State& state, const char* block) {
  std::array<std::uint32_t, 64> w{};
  for (std::size_t i = 0; i < 64; ++i) {
    w[i / 4] = w[i / 4] << 8 | static_cast<std::uint8_t>(block[i]);
  }
  for (std::size_t i = 16; i < 64; ++i) {
    const std::uint32_t a = w[i - 15];
    const std::uint32_t b = w[i - 2];
    w[i] = w[i - 16] + (std::rotr(a, 7) ^ std::rotr(a, 18) ^ a >> 3) + w[i - 7] +
           (std::rotr(b, 17) ^ std::rotr(b, 19) ^ b >> 10);
  }
  auto [a, b, c, d, e, f, g, h] = state;
  for (std::size_t i = 0; i < 64; ++i) {
    const std::uint32_t t1 = h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) +
                             ((e & f) ^ (~e & g)) + kSha256[i] + w[i];
    const std::uint32_t t2 =
        (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
    h = g;
    g = f;
    f = e;
    e = d + t1;
    d = c;
    c = b;
    b = a;
    a = t1 + t2;
  }
  const Sha256State added = {a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < state.size(); ++i) state[i] += added[i];
}

}  // namespace

std::string sha256(std::string_view bytes) {
  constexpr std::size_t kBlock = 64;
  std::string padded(bytes);
  padded += '\x80';
  while (padded.size() % kBlock != kBlock - 8) padded += '\0';
  for (int shift = 56; shift >= 0; shift -= 8) {
    padded += static_cast<char>(std::uint64_t{bytes.size()} * 8 >> shift);
  }
  Sha256State state = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                       0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  for (std::size_t at = 0; at < padded.size(); at += kBlock) add_block(state, &padded[at]);
  std::string text;
  for (const std::uint32_t word : state) {
    for (int shift = 28; shift >= 0; shift -= 4) text += "0123456789abcdef"[word >> shift & 15U];
  }
  return text;
}

std::string type_hash(std::string_view name, std::string_view definition) {
  const std::string own(name);
  std::map<std::string, std::string> used;
  describe(own, split_definition(name, definition), used);
  std::string nested;
  for (const auto& [type, json] : used) {
    if (type != own) nested += (nested.empty() ? "" : ", ") + json;
  }
  return "RIHS01_" + sha256(R"({"type_description": )" + used[own] +
                            R"(, "referenced_type_descriptions": [)" + nested + "]}");
}

}  // namespace mms::msg
