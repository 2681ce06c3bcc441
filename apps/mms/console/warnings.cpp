#include "apps/mms/console/warnings.hpp"

#include <fmt/core.h>

namespace mms {

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) fmt::print(stderr, "warning: {}\n", warning);
}

}  // namespace mms
