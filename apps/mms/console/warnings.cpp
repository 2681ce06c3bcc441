#include "apps/mms/console/warnings.hpp"

#include <fmt/core.h>

namespace mms {

std::string printable(std::string text) {
  constexpr std::size_t kMaxLength = 2000;
  constexpr std::size_t kEnd = 500;  // kept: it has the hint
  if (text.size() > kMaxLength) {
    text.replace(kMaxLength - kEnd, text.size() - kMaxLength, " ... ");
  }
  for (char& c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte < 0x20 && c != '\n') || byte == 0x7F) c = '?';
  }
  return text;
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) {
    fmt::print(stderr, "warning: {}\n", printable(warning));
  }
}

}  // namespace mms
