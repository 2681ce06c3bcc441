#pragma once

#include <string_view>

namespace mms {

/// Whether a request comes from a page of this server, or from a program other than a browser: the
/// Origin header equals the Host or is absent.
/// @param origin  empty: absent
bool is_own_origin(std::string_view origin, std::string_view host);

/// Whether a host name means this machine. A server on loopback rejects others, as a protection
/// against DNS rebinding.
bool is_loopback_name(std::string_view host);

}  // namespace mms
