#include "viewing.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "interrupt.hpp"
#include "mms/io/numbers.hpp"

namespace mms {

std::uint16_t checked_port(const std::string& option, const std::string& word) {
  constexpr std::int64_t kLargest = 65535;
  const std::optional<std::int64_t> port = parse_integer(word);
  if (port && *port >= 0 && *port <= kLargest) return static_cast<std::uint16_t>(*port);
  throw CLI::ValidationError(option, fmt::format("'{}' is no port, 0 to {} are", word, kLargest));
}

void add_bind_option(CLI::App& command, ViewOptions& options) {
  command
      .add_option("--bind", options.bind,
                  "address to serve the viewer at; 0.0.0.0 lets all who reach this machine see the "
                  "run and fetch its files")
      ->capture_default_str();
}

std::unique_ptr<ViewerServer> serve(const ViewOptions& options, std::shared_ptr<Scene> scene,
                                    const std::string& port_hint, bool background) {
  ServerOptions server_options;
  server_options.address = options.bind;
  server_options.port = options.port;
  server_options.port_hint = port_hint;
  server_options.version = MMS_VERSION;
  server_options.background = background;
  auto server = std::make_unique<ViewerServer>(server_options, std::move(scene));
  fmt::print(stderr, "viewer: {}\n", server->url());
  if (server->is_open()) {
    fmt::print(stderr,
               "warning: the viewer is open to the network ({} port {}): whoever reaches this "
               "machine can see the run and fetch its files; there is no password\n",
               options.bind, server->port());
  }
  return server;
}

void wait_for_interrupt() {
  const InterruptGuard interrupt;
  while (!InterruptGuard::requested()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

}  // namespace mms
