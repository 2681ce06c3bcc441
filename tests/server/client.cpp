#include "tests/server/client.hpp"

#include <poll.h>

#include <algorithm>
#include <array>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <thread>

namespace mms::testing {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;
using tcp = asio::ip::tcp;

constexpr int kReadTimeout = 2000;  // [ms]

tcp::endpoint endpoint(std::uint16_t port) {
  return {asio::ip::address_v4::loopback(), port};
}

std::string host(std::uint16_t port) {
  return "localhost:" + std::to_string(port);
}

std::string text_of(beast::string_view value) {
  return {value.data(), value.size()};
}

}  // namespace

HttpAnswer http_get(std::uint16_t port, const std::string& path, const std::string& headers) {
  const bool with_host = headers.find("Host:") == std::string::npos;
  const std::string answer =
      send_raw(port, "GET " + path + " HTTP/1.1\r\n" +
                         (with_host ? "Host: " + host(port) + "\r\n" : std::string()) + headers +
                         "Connection: close\r\n\r\n");
  http::response_parser<http::string_body> parser;
  parser.eager(true);
  parser.body_limit(boost::none);
  beast::error_code error;
  parser.put(asio::buffer(answer), error);
  const auto& response = parser.get();
  return {static_cast<int>(response.result_int()), text_of(response[http::field::content_type]),
          text_of(response["Content-Security-Policy"]), response.body()};
}

std::size_t download_slowly(std::uint16_t port, const std::string& path, std::size_t part,
                            std::chrono::milliseconds pause) {
  asio::io_context io;
  tcp::socket socket(io);
  socket.open(tcp::v4());
  socket.set_option(asio::socket_base::receive_buffer_size(static_cast<int>(part)));
  socket.connect(endpoint(port));
  asio::write(socket, asio::buffer("GET " + path + " HTTP/1.1\r\nHost: " + host(port) +
                                   "\r\nConnection: close\r\n\r\n"));
  std::string answer;
  std::string bytes(part, '\0');
  beast::error_code error;
  while (!error) {
    answer.append(bytes, 0, socket.read_some(asio::buffer(bytes), error));
    std::this_thread::sleep_for(pause);
  }
  return answer.size() - std::min(answer.size(), answer.find("\r\n\r\n") + 4);
}

std::string send_raw(std::uint16_t port, const std::string& bytes, const std::string& enough) {
  asio::io_context io;
  tcp::socket socket(io);
  socket.connect(endpoint(port));
  beast::error_code error;
  asio::write(socket, asio::buffer(bytes), error);
  std::string answer;
  char part[65536];
  pollfd waiting{socket.native_handle(), POLLIN, 0};
  while (poll(&waiting, 1, kReadTimeout) > 0) {
    const std::size_t size = socket.read_some(asio::buffer(part), error);
    if (error) break;
    answer.append(part, size);
    if (!enough.empty() && answer.find(enough) != std::string::npos) break;
  }
  return answer;
}

class SlowClient::Parts {
 public:
  Parts(std::uint16_t port, const std::string& bytes) : socket_(io_) {
    socket_.connect(endpoint(port));
    asio::write(socket_, asio::buffer(bytes));
  }

  bool is_open() {
    socket_.non_blocking(true);
    std::array<char, 1> byte{};
    boost::system::error_code error;
    socket_.read_some(asio::buffer(byte), error);
    return !error || error == asio::error::would_block;
  }

 private:
  asio::io_context io_;
  tcp::socket socket_;
};

SlowClient::SlowClient(std::uint16_t port, const std::string& bytes)
    : parts_(std::make_unique<Parts>(port, bytes)) {}

SlowClient::~SlowClient() = default;

bool SlowClient::is_open() {
  return parts_->is_open();
}

int upgrade_status(std::uint16_t port, const std::string& origin) {
  const std::string answer =
      send_raw(port,
               "GET /ws HTTP/1.1\r\nHost: " + host(port) +
                   "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13"
                   "\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" +
                   (origin.empty() ? "" : "Origin: " + origin + "\r\n") + "\r\n",
               "\r\n\r\n");
  return answer.starts_with("HTTP/1.1 ") ? std::stoi(answer.substr(9, 3)) : 0;
}

class ViewerClient::Parts {
 public:
  explicit Parts(std::uint16_t port) : socket_(io_) {
    beast::get_lowest_layer(socket_).connect(endpoint(port));
    beast::error_code error;
    socket_.handshake(host(port), "/ws", error);
    if (error) throw std::runtime_error("rejected: " + error.message());
    socket_.read_message_max(256 << 20);
  }

  void send(const std::string& text, bool binary) {
    beast::error_code ignored;
    socket_.binary(binary);
    socket_.write(asio::buffer(text), ignored);
  }

  std::optional<std::string> read() {
    beast::flat_buffer buffer;
    beast::error_code error;
    bool done = false;
    socket_.async_read(buffer, [&](beast::error_code given, std::size_t) {
      error = given;
      done = true;
    });
    io_.restart();
    io_.run_for(std::chrono::seconds(10));
    if (!done) {
      drop();
      io_.run();
      throw std::runtime_error("no message within ten seconds");
    }
    if (error) return std::nullopt;
    return beast::buffers_to_string(buffer.data());
  }

  void drop() {
    beast::error_code ignored;
    beast::get_lowest_layer(socket_).close(ignored);
  }

 private:
  asio::io_context io_;
  websocket::stream<tcp::socket> socket_;
};

ViewerClient::ViewerClient(std::uint16_t port) : parts_(std::make_unique<Parts>(port)) {}

ViewerClient::~ViewerClient() = default;

void ViewerClient::send(const std::string& text, bool binary) {
  parts_->send(text, binary);
}

std::optional<DecodedMessage> ViewerClient::read() {
  const std::optional<std::string> bytes = read_bytes();
  if (!bytes) return std::nullopt;
  return decode_message(*bytes);
}

std::optional<std::string> ViewerClient::read_bytes() {
  return parts_->read();
}

DecodedMessage ViewerClient::wait_for(const std::string& type) {
  for (int i = 0; i < 10000; ++i) {
    std::optional<DecodedMessage> message = read();
    if (!message) throw std::runtime_error("closed while waiting for " + type);
    if (message->type() == type) return std::move(*message);
  }
  throw std::runtime_error("no " + type + " arrived");
}

void ViewerClient::drop() {
  parts_->drop();
}

}  // namespace mms::testing
