#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "mms/server/scene/viewer_scene.hpp"

namespace mms {

struct ServerOptions {
  std::string address = "127.0.0.1";             ///< address to listen on
  std::uint16_t port = 8080;                     ///< 0: any free port
  std::string port_hint;                         ///< hint for the error if the port is in use
  std::string version;                           ///< of the program, for the page
  bool background = false;                       ///< its threads have low priority
  std::size_t max_viewers = 32;                  ///< simultaneous; further ones are rejected
  std::chrono::milliseconds send_time{120'000};  ///< for each part of a download
};

/// Serves the viewer page, a run's files and, over WebSocket, the run itself
/// (docs/viewer_protocol.md) in its own threads until destruction.
class ViewerServer {
 public:
  /// Starts to listen.
  /// @throws DataError if the address is invalid or not of this machine, or the port is in use.
  ViewerServer(const ServerOptions& options, std::shared_ptr<Scene> scene);

  /// Closes all connections.
  ~ViewerServer();
  ViewerServer(const ViewerServer&) = delete;
  ViewerServer& operator=(const ViewerServer&) = delete;

  std::uint16_t port() const;

  /// URL of the page: "http://localhost:8080".
  std::string url() const;

  /// Whether other machines can connect.
  bool is_open() const;

  std::size_t viewers() const;  ///< connected now

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace mms
