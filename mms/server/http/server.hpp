#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "mms/server/scene/scene.hpp"

namespace mms {

struct ServerOptions {
  std::string address = "127.0.0.1";  ///< to listen at
  std::uint16_t port = 8080;          ///< 0: any that is free
  std::string port_hint;              ///< what to do where the port is taken, for the error
  std::string version;                ///< of the program, for the page
  bool background = false;            ///< its threads give way to all others
  std::size_t max_viewers = 32;       ///< at once; others are told to come later
};

/// Serves the viewer's page, a run's files and, over WebSocket, the run itself
/// (docs/viewer_protocol.md), in threads of its own until it goes.
class ViewerServer {
 public:
  /// Listens from now on.
  /// @throws DataError when the address is none, not this machine's, or the port is taken.
  ViewerServer(const ServerOptions& options, std::shared_ptr<Scene> scene);

  /// Says goodbye to all viewers.
  ~ViewerServer();
  ViewerServer(const ViewerServer&) = delete;
  ViewerServer& operator=(const ViewerServer&) = delete;

  std::uint16_t port() const;

  /// Where the page is: "http://localhost:8080".
  std::string url() const;

  /// Whether other machines can reach it.
  bool is_open() const;

  std::size_t viewers() const;  ///< connected now

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace mms
