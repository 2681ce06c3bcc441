#include "apps/mms/console/viewing.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "apps/mms/console/interrupt.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {

std::uint16_t checked_port(const std::string& option, const std::string& word) {
  constexpr std::int64_t kMaxPort = 65535;
  const std::optional<std::int64_t> port = parse_integer(word);
  if (port && *port >= 0 && *port <= kMaxPort) return static_cast<std::uint16_t>(*port);
  throw CLI::ValidationError(option,
                             fmt::format("'{}' is not a port; allowed: 0 to {}", word, kMaxPort));
}

void add_bind_option(CLI::App& command, ViewOptions& options) {
  command
      .add_option(
          "--bind", options.bind,
          "address of the viewer; with 0.0.0.0 other machines can see the run and fetch its files")
      ->capture_default_str();
}

void announce(const ViewerServer& server, const ViewOptions& options) {
  fmt::print(stderr, "viewer: {}{}\n", server.url(),
             server.is_open() ? "" : " (for this machine alone; --bind opens it to others)");
  if (server.is_open()) {
    fmt::print(stderr,
               "warning: the viewer is open to the network ({} port {}): everyone with access to "
               "this machine can see the run and fetch its files; there is no password\n",
               options.bind, server.port());
  }
}

void wait_for_interrupt() {
  const InterruptGuard interrupt;
  while (!InterruptGuard::requested()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

}  // namespace mms
