#include "mms/server/http/http_session.hpp"

#include <boost/asio/post.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/version.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <memory>
#include <optional>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/server/http/answer.hpp"
#include "mms/server/http/viewer_session.hpp"
#include "mms/server/scene/downloads.hpp"

namespace mms {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;

constexpr std::uint32_t kMaxHeader = 8 * 1024;  ///< bytes
constexpr std::uint64_t kMaxBody = 1024;        ///< bytes; bodies are ignored
constexpr std::chrono::seconds kReadTime{15};

using Request11 = http::request<http::string_body>;

std::string text_of(const Request11& request, http::field field) {
  const auto value = request[field];
  return {value.data(), value.size()};
}

Request request_of(const Request11& given) {
  Request request;
  request.reads = given.method() == http::verb::get || given.method() == http::verb::head;
  request.target = std::string(given.target().data(), given.target().size());
  request.host = text_of(given, http::field::host);
  request.origin = text_of(given, http::field::origin);
  request.known_tag = text_of(given, http::field::if_none_match);
  request.upgrades = beast::websocket::is_upgrade(given);
  return request;
}

class HttpSession : public std::enable_shared_from_this<HttpSession>, public Connection {
 public:
  HttpSession(Service& service, asio::ip::tcp::socket socket)
      : service_(service), stream_(std::move(socket)) {
    ++service_.connections;
  }
  ~HttpSession() override {
    leave();
    --service_.connections;
  }
  HttpSession(const HttpSession&) = delete;
  HttpSession& operator=(const HttpSession&) = delete;

  void read() {
    parser_.emplace();
    parser_->header_limit(kMaxHeader);
    parser_->body_limit(kMaxBody);
    stream_.expires_after(kReadTime);
    enter(service_.waiting);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) {
                       self->received(error);
                     });
  }

  void drop() override {
    leave();
    stream_.close();
  }

 private:
  using List = std::list<Connection*>;

  void enter(List& list) {
    leave();
    list_ = &list;
    place_ = list.insert(list.end(), this);
  }

  void leave() {
    if (list_ != nullptr) list_->erase(place_);
    list_ = nullptr;
  }

  void received(beast::error_code error) {
    enter(service_.answering);
    if (error == http::error::header_limit || error == http::error::body_limit) {
      return refuse(text_answer(413, "the request is too large"));
    }
    if (error && error.category() == http::make_error_code(http::error::bad_method).category() &&
        error != http::error::end_of_stream && error != http::error::partial_message) {
      return refuse(text_answer(400, "invalid HTTP request"));
    }
    if (error) return;  // closed, or timeout
    request_ = parser_->release();
    head_ = request_.method() == http::verb::head;
    Answer answer = answer_to(request_of(request_), *service_.scene, service_.loopback);
    if (answer.kind == Answer::Kind::kWebSocket) return upgrade();
    if (answer.kind == Answer::Kind::kLiveFile) return make_file(std::move(answer));
    send(answer);
  }

  void upgrade() {
    if (service_.viewers >= service_.options.max_viewers || service_.closing) {
      return send(text_answer(503, "the maximum number of viewers is connected"));
    }
    leave();
    stream_.expires_never();  // WebSocket has its own timeouts
    start_viewer(service_, std::move(stream_), std::move(request_));
  }

  /// Writes a file of a live run, sends it, and removes it.
  void make_file(Answer answer) {
    stream_.expires_never();
    asio::post(service_.encoder, [self = shared_from_this(), answer = std::move(answer)]() mutable {
      std::shared_ptr<const LiveDownload> download;
      try {
        download = write_live_download(*self->service_.scene, answer.live_file);
        answer.file = download->file.path();
        answer.kind = Answer::Kind::kFile;
      } catch (const std::exception& error) {
        answer = text_answer(500, error.what());
      }
      // The download is removed after it was opened, which keeps it readable.
      asio::post(self->service_.io, [self, answer, download] { self->send(answer); });
    });
  }

  void refuse(const Answer& answer) {
    request_ = {};
    request_.version(11);
    request_.keep_alive(false);
    send(answer);
  }

  void send(const Answer& answer) {
    switch (answer.kind) {
      case Answer::Kind::kBytes: {
        http::response<http::span_body<const char>> response;
        response.body() = {answer.bytes.data(), answer.bytes.size()};
        return send(answer, std::move(response));
      }
      case Answer::Kind::kFile: {
        http::response<http::file_body> response;
        beast::error_code error;
        response.body().open(answer.file.c_str(), beast::file_mode::scan, error);
        if (error) return send(text_answer(404, "the file cannot be read"));
        return send(answer, std::move(response));
      }
      default: {
        http::response<http::string_body> response;
        response.body() = answer.text;
        return send(answer, std::move(response));
      }
    }
  }

  template <class Body>
  void send(const Answer& answer, http::response<Body> given) {
    auto response = std::make_shared<http::response<Body>>(std::move(given));
    fill_header(answer, *response);
    if (answer.status != 304) response->prepare_payload();
    auto serializer = std::make_shared<http::response_serializer<Body>>(*response);
    if (!head_) return send_part(response, serializer);
    stream_.expires_after(service_.options.send_time);
    http::async_write_header(
        stream_, *serializer,
        [self = shared_from_this(), response, serializer](beast::error_code error, std::size_t) {
          self->finish(error, response->need_eof());
        });
  }

  /// The time limit is that of each part, since a large file takes long over a slow network.
  template <class Response, class Serializer>
  void send_part(const Response& response, const Serializer& serializer) {
    stream_.expires_after(service_.options.send_time);
    http::async_write_some(
        stream_, *serializer,
        [self = shared_from_this(), response, serializer](beast::error_code error, std::size_t) {
          if (!error && !serializer->is_done()) return self->send_part(response, serializer);
          self->finish(error, response->need_eof());
        });
  }

  void finish(beast::error_code error, bool is_last) {
    if (error || is_last) return close();
    read();
  }

  template <class Body>
  void fill_header(const Answer& answer, http::response<Body>& response) const {
    response.version(request_.version());
    response.result(static_cast<unsigned>(answer.status));
    response.keep_alive(request_.keep_alive());
    response.set(http::field::content_type, answer.type);
    response.set(http::field::cache_control, answer.cache);
    response.set("Content-Security-Policy", answer.policy);
    response.set("X-Content-Type-Options", "nosniff");
    response.set("X-Frame-Options", "DENY");
    response.set("Referrer-Policy", "no-referrer");
    response.set("Cross-Origin-Resource-Policy", "same-origin");
    if (!answer.tag.empty()) response.set(http::field::etag, answer.tag);
    if (!answer.download_name.empty()) {
      response.set(http::field::content_disposition,
                   "attachment; filename=\"" + answer.download_name + "\"");
    }
  }

  void close() {
    beast::error_code ignored;
    stream_.socket().shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
  }

  Service& service_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  Request11 request_;
  bool head_ = false;
  List* list_ = nullptr;  // with this connection at `place_`
  List::iterator place_;
};

}  // namespace

void start_http(Service& service, asio::ip::tcp::socket socket) {
  std::make_shared<HttpSession>(service, std::move(socket))->read();
}

}  // namespace mms
