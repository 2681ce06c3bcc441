#include "mms/server/http/origin.hpp"

namespace mms {
namespace {

/// "[::1]" of "[::1]:8080", "localhost" of "localhost:8080".
std::string_view host_name(std::string_view host) {
  const std::size_t bracket = host.rfind(']');
  const std::size_t colon = host.rfind(':');
  const bool has_port =
      colon != std::string_view::npos && (bracket == std::string_view::npos || colon > bracket);
  return has_port ? host.substr(0, colon) : host;
}

}  // namespace

bool is_own_origin(std::string_view origin, std::string_view host) {
  if (origin.empty()) return true;
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (origin.starts_with(scheme)) return origin.substr(scheme.size()) == host;
  }
  return false;
}

bool is_loopback_name(std::string_view host) {
  const std::string_view name = host_name(host);
  return name == "localhost" || name == "127.0.0.1" || name == "[::1]";
}

}  // namespace mms
