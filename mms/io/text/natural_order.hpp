#pragma once

#include <string_view>

namespace mms {

/// Whether a name comes before another one in the order of the numbers in them: a2 before a10.
bool natural_less(std::string_view a, std::string_view b);

}  // namespace mms
