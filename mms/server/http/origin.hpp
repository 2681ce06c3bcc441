#pragma once

#include <string_view>

namespace mms {

/// "[::1]" of "[::1]:8080", "localhost" of "localhost:8080".
std::string_view host_name(std::string_view host);

/// Whether a request may have come from a page of this server, and not from another that the user
/// has open: the browser's Origin is that of the Host that was asked. Programs that are no browsers
/// send none.
/// @param origin  empty: the request has none
bool is_own_origin(std::string_view origin, std::string_view host);

/// Whether a name stands for this machine alone. A server on loopback answers to no other, so that
/// a foreign name that was made to lead to 127.0.0.1 (DNS rebinding) gets nothing.
bool is_loopback_name(std::string_view host);

}  // namespace mms
