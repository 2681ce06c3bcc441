#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cmath>
#include <stdexcept>

#include "mms/core/error.hpp"
#include "mms/io/weights/safetensors.hpp"
#include "mms/segmentation/onnx/class_names.hpp"
#include "mms/segmentation/onnx/model_header.hpp"
#include "mms/segmentation/weights/checkpoint_import.hpp"
#include "mms/segmentation/weights/model.hpp"
#include "mms/server/http/answer.hpp"
#include "mms/server/http/server.hpp"
#include "mms/server/viewer/command.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/segmentation/tiny_onnx.hpp"
#include "tests/server/scenes.hpp"

namespace mms::testing {
namespace {

using Seeds = std::vector<std::string>;

Seeds onnx_seeds() {
  return {tiny_onnx({}), tiny_onnx({.format = onnx::YoloFormat::kV5, .side = 0})};
}

void read_onnx_bytes(std::string_view bytes) {
  onnx::read_model_header(bytes, "input");
}

Seeds class_name_seeds() {
  return {"{0: 'person', 1: 'traffic light'}", R"(["a'b", 'c\\'])"};
}

void read_class_name_bytes(std::string_view bytes) {
  onnx::python_names(bytes);
  onnx::listed_names(bytes, "input");
}

Seeds model_seeds() {
  SegmentationModel model;
  model.classes.assign(static_cast<std::size_t>(model.network.classes), "person");
  Weights weights = pack_model(model);
  weights.tensors["backbone.conv1.weight"] = {{2, 3, 1, 1}, {1, 2, 3, 4, 5, 6}};
  const auto bytes = encode_safetensors(weights, TensorType::kFloat32, "seed");
  return {{bytes.begin(), bytes.end()}};
}

void read_model_bytes(std::string_view bytes) {
  const Weights weights = parse_safetensors(
      {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, "input");
  try {
    import_checkpoint(weights, "input");
  } catch (const Error&) {  // may still be our own model
  }
  unpack_model(weights, "input");
}

Seeds command_seeds() {
  return {R"({"type":"pause"})",
          R"({"type":"seek","frame":3})",
          R"({"type":"step","by":-1})",
          R"({"type":"speed","value":1.5})",
          R"({"type":"want","points":true,"image":false,"map":true,"budget":1000})",
          R"({"type":"focus","point":[1,2,3]})"};
}

void read_command_bytes(std::string_view bytes) {
  parse_command(bytes);
}

/// A connection to the server below, closed at its end.
class Connected {
 public:
  explicit Connected(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    constexpr timeval kWait{5, 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &kWait, sizeof kWait);
    if (::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) return;
    ::close(socket_);
    throw std::runtime_error("the server does not listen any more");
  }
  ~Connected() { ::close(socket_); }
  Connected(const Connected&) = delete;
  Connected& operator=(const Connected&) = delete;

  /// Sends the bytes and reads until the server closes.
  void exchange(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) break;  // the server has closed already
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    ::shutdown(socket_, SHUT_WR);
    char buffer[4096];
    ssize_t received = 1;
    while (received > 0) received = ::recv(socket_, buffer, sizeof buffer, 0);
    if (received < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) {
      throw std::runtime_error("the server does not close the connection");
    }
  }

 private:
  int socket_;
};

const std::string kUpgrade =
    "GET /ws HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
    "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";

/// A text frame of a client, whose mask is zero.
std::string text_frame(const std::string& text) {
  return std::string("\x81", 1) + static_cast<char>(0x80 | text.size()) + std::string(4, '\0') +
         text;
}

Seeds http_seeds() {
  Seeds seeds = {
      "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n",
      "HEAD /files/static_map.ply HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n",
      "GET /files/../../etc/passwd?x=1 HTTP/1.0\r\nHost: 127.0.0.1:80\r\n\r\n",
      "POST / HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n"
      "3\r\nabc\r\n0\r\n\r\n"};
  std::string frames = kUpgrade;
  for (const std::string& command : command_seeds()) frames += text_frame(command);
  seeds.push_back(frames);
  return seeds;
}

void read_http_bytes(std::string_view bytes) {
  static const ViewerServer server(
      [] {
        ServerOptions options;
        options.port = 0;
        return options;
      }(),
      finished_scene(3));
  Connected(server.port()).exchange(bytes);
}

/// Lines: target, Host, Origin, tag.
Seeds request_seeds() {
  return {"/\nlocalhost:8080\nhttp://localhost:8080\n\"1-2\"",
          "/files/static_map.ply\n[::1]:80\n\n"};
}

void read_request_bytes(std::string_view bytes) {
  static const auto scene = finished_scene(3);
  Request request;
  for (std::string* part : {&request.target, &request.host, &request.origin, &request.known_tag}) {
    const std::size_t end = std::min(bytes.find('\n'), bytes.size());
    *part = bytes.substr(0, end);
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
  }
  answer_to(request, *scene, true);
  answer_to(request, *scene, false);
}

}  // namespace

std::vector<FuzzTarget> network_targets() {
  return {{"onnx", onnx_seeds, read_onnx_bytes},
          {"class_names", class_name_seeds, read_class_name_bytes},
          {"model", model_seeds, read_model_bytes},
          {"viewer_command", command_seeds, read_command_bytes},
          {"http_request", request_seeds, read_request_bytes},
          {"http", http_seeds, read_http_bytes}};
}

}  // namespace mms::testing
