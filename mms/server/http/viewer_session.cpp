#include "mms/server/http/viewer_session.hpp"

#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>
#include <utility>

#include "mms/server/viewer/viewer.hpp"

namespace mms {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;

constexpr std::chrono::milliseconds kTick{33};
constexpr std::chrono::seconds kHandshakeTime{10};
constexpr std::chrono::seconds kIdleTime{30};  ///< without an answer to a ping
constexpr int kMaxCommandsPerTick = 20;        ///< others wait
constexpr int kMaxFaults = 100;                ///< then the connection is closed
/// Send buffer of the socket, small because a slow viewer's messages become outdated.
constexpr int kSendBuffer = 256 * 1024;

/// Result of `make`, or nullopt on failure, such as lack of memory or a damaged image.
template <class Result, class Make>
Result try_make(const Make& make) {
  try {
    return make();
  } catch (const std::exception&) {
    return Result();
  }
}

/// WebSocket of one viewer. Runs in the thread of the sockets, except for tasks posted to the other
/// two.
class ViewerSession : public std::enable_shared_from_this<ViewerSession> {
 public:
  using Clock = Viewer::Clock;

  ViewerSession(Service& service, beast::tcp_stream stream)
      : service_(service),
        socket_(std::move(stream)),
        timer_(service_.io),
        viewer_(*service_.scene, service_.options.version) {
    ++service_.viewers;
  }
  ~ViewerSession() { --service_.viewers; }

  void start(http::request<http::string_body> request) {
    websocket::stream_base::timeout limits{kHandshakeTime, kIdleTime, true};
    socket_.set_option(limits);
    socket_.read_message_max(kMaxCommandBytes);
    socket_.binary(true);
    socket_.auto_fragment(false);
    beast::error_code ignored;
    auto& stream = beast::get_lowest_layer(socket_).socket();
    stream.set_option(asio::socket_base::send_buffer_size(kSendBuffer), ignored);
    stream.set_option(asio::ip::tcp::no_delay(true), ignored);
    const auto shared = std::make_shared<http::request<http::string_body>>(std::move(request));
    socket_.async_accept(*shared, [self = shared_from_this(), shared](beast::error_code error) {
      if (error) return;
      self->read();
      self->tick();
    });
  }

 private:
  void read() {
    if (commands_ >= kMaxCommandsPerTick) {
      reading_ = false;  // until the next tick
      return;
    }
    reading_ = true;
    socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      error ? self->end() : self->received();
    });
  }

  void received() {
    ++commands_;
    const std::string text = beast::buffers_to_string(buffer_.data());
    buffer_.consume(buffer_.size());
    if (!viewer_.receive(text, Clock::now()) && ++faults_ > kMaxFaults) return end();
    pump();
    read();
  }

  void tick() {
    if (ended_) return;
    if (service_.closing) return say_goodbye();
    commands_ = 0;
    if (!reading_) read();
    viewer_.tick(Clock::now());
    load_pictures();
    plan_map();
    pump();
    timer_.expires_after(kTick);
    timer_.async_wait([self = shared_from_this()](beast::error_code error) {
      if (!error) self->tick();
    });
  }

  /// Sends the next message after the previous one is written.
  void pump() {
    if (busy_ || ended_) return;
    const auto encode = viewer_.next(Clock::now());
    if (!encode) return;
    busy_ = true;
    asio::post(service_.encoder, [self = shared_from_this(), encode = *encode] {
      const Message message = try_make<Message>(encode);
      self->back([self, message] { message ? self->write(message) : self->end(); });
    });
  }

  void write(const Message& message) {
    if (ended_) return;
    socket_.async_write(asio::buffer(*message),
                        [self = shared_from_this(), message](beast::error_code error, std::size_t) {
                          self->busy_ = false;
                          if (error) return self->end();
                          self->pump();
                        });
  }

  void load_pictures() {
    const auto wanted = viewer_.requested_pictures(Clock::now());
    if (!wanted) return;
    asio::post(service_.loader, [self = shared_from_this(), frame = *wanted] {
      const auto pictures =
          try_make<Viewer::Pictures>([&] { return self->service_.pictures.get(frame); });
      self->back([self, pictures] {
        self->viewer_.loaded(pictures);
        self->pump();
      });
    });
  }

  void plan_map() {
    const auto known = viewer_.wants_plan(Clock::now());
    if (!known) return;
    asio::post(service_.encoder, [self = shared_from_this(), known = *known] {
      std::optional<std::vector<ChunkState>> chunks;
      const std::uint64_t version = self->service_.scene->read_map([&](const MapChunks& map) {
        if (map.version() != known) chunks = map.states();
        return map.version();
      });
      self->back([self, version, chunks = std::move(chunks)] {
        self->viewer_.plan_map(chunks, version, Clock::now());
        self->pump();
      });
    });
  }

  /// Continues in the thread of the sockets.
  template <class Next>
  void back(Next next) {
    asio::post(service_.io, std::move(next));
  }

  void say_goodbye() {
    ended_ = true;
    socket_.async_close(websocket::close_code::going_away,
                        [self = shared_from_this()](beast::error_code) {});
  }

  void end() {
    if (std::exchange(ended_, true)) return;
    timer_.cancel();
    beast::error_code ignored;
    beast::get_lowest_layer(socket_).socket().shutdown(asio::ip::tcp::socket::shutdown_both,
                                                       ignored);
    beast::get_lowest_layer(socket_).close();
  }

  Service& service_;
  websocket::stream<beast::tcp_stream> socket_;
  asio::steady_timer timer_;
  beast::flat_buffer buffer_;
  Viewer viewer_;
  bool busy_ = false;  // a message is being encoded or written
  bool reading_ = false;
  bool ended_ = false;
  int commands_ = 0;  // since the last tick
  int faults_ = 0;
};

}  // namespace

void start_viewer(Service& service, beast::tcp_stream stream,
                  http::request<http::string_body> request) {
  std::make_shared<ViewerSession>(service, std::move(stream))->start(std::move(request));
}

}  // namespace mms
