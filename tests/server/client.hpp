#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "tests/server/decoded_message.hpp"

namespace mms::testing {

/// HTTP answer of a server.
struct HttpAnswer {
  int status = 0;
  std::string type;
  std::string policy;
  std::string body;
};

/// Sends a GET with more headers ("Name: value\r\n..."). The path is not encoded.
HttpAnswer http_get(std::uint16_t port, const std::string& path, const std::string& headers = "");

/// Sends bytes unchanged and reads until the server closes, sends nothing for two seconds, or has
/// sent `enough`.
std::string send_raw(std::uint16_t port, const std::string& bytes, const std::string& enough = "");

/// Size of a body that is received in parts of at most `part` bytes with pauses between them.
std::size_t download_slowly(std::uint16_t port, const std::string& path, std::size_t part,
                            std::chrono::milliseconds pause);

/// A client that sends a part of a request and nothing more.
class SlowClient {
 public:
  SlowClient(std::uint16_t port, const std::string& bytes);
  ~SlowClient();
  SlowClient(const SlowClient&) = delete;
  SlowClient& operator=(const SlowClient&) = delete;

  /// Whether the server has not closed the connection.
  bool is_open();

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

/// The HTTP status for a viewer of that origin: 101 if it is accepted.
int upgrade_status(std::uint16_t port, const std::string& origin);

/// A WebSocket client. Reading waits at most ten seconds.
class ViewerClient {
 public:
  /// @throws std::runtime_error when the server rejects the connection.
  explicit ViewerClient(std::uint16_t port);
  ~ViewerClient();
  ViewerClient(const ViewerClient&) = delete;
  ViewerClient& operator=(const ViewerClient&) = delete;

  void send(const std::string& text, bool binary = false);

  /// The next message; nothing when the connection is closed.
  std::optional<DecodedMessage> read();
  std::optional<std::string> read_bytes();

  /// Reads until a message of that type arrives. @throws std::runtime_error if none does.
  DecodedMessage wait_for(const std::string& type);

  /// Closes the socket without a closing handshake.
  void drop();

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace mms::testing
