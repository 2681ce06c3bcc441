#include "mms/server/http/server.hpp"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/system/error_code.hpp>
#include <chrono>
#include <functional>
#include <thread>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/server/http/http_session.hpp"
#include "mms/server/http/service.hpp"

namespace mms {
namespace {

namespace asio = boost::asio;
using tcp = asio::ip::tcp;
using ErrorCode = boost::system::error_code;

constexpr std::size_t kMaxConnections = 128;  ///< beyond it, the oldest ones are closed
constexpr std::chrono::milliseconds kGoodbyeTime{1000};
constexpr std::chrono::milliseconds kAcceptPause{100};  ///< if the system is out of sockets
constexpr std::chrono::seconds kMapPeriod{2};           ///< between map updates without viewers
constexpr int kNiceness = 15;                           ///< of background threads

/// Lowers the priority of the calling thread.
void lower_priority() {
  setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), kNiceness);
}

[[noreturn]] void fail(const ServerOptions& options, const ErrorCode& error) {
  const std::string where = options.address + " port " + std::to_string(options.port);
  const auto hint = options.port_hint.empty() ? "" : ": " + options.port_hint;
  if (error == asio::error::address_in_use) {
    throw DataError(where, "is in use by another program", "end it or choose another port" + hint);
  }
  if (error == asio::error::access_denied) {
    throw DataError(where, "requires privileges", "choose a port above 1023" + hint);
  }
  throw DataError(where, "cannot be used: " + error.message(),
                  "use an address of this machine, or 0.0.0.0 for all");
}

asio::ip::address address_of(const ServerOptions& options) {
  ErrorCode error;
  auto address =
      asio::ip::make_address(options.address == "localhost" ? "127.0.0.1" : options.address, error);
  if (error) {
    throw DataError("--bind", "'" + options.address + "' is not an address",
                    "expected an address of this machine such as 192.168.1.5, or 0.0.0.0 for all");
  }
  return address;
}

}  // namespace

class ViewerServer::Parts {
 public:
  Parts(const ServerOptions& options, std::shared_ptr<Scene> scene)
      : service_(options, std::move(scene)),
        acceptor_(service_.io),
        pause_(service_.io),
        map_timer_(service_.io) {
    listen();
    accept();
    apply_map_changes();
    if (options.background) {
      asio::post(service_.encoder, lower_priority);
      asio::post(service_.loader, lower_priority);
    }
    thread_ = std::thread([this, background = options.background] {
      if (background) lower_priority();
      service_.io.run();
    });
  }

  ~Parts() {
    service_.closing = true;
    asio::post(service_.io, [this] {
      ErrorCode ignored;
      acceptor_.close(ignored);
    });
    const auto deadline = std::chrono::steady_clock::now() + kGoodbyeTime;
    while (service_.viewers > 0 && std::chrono::steady_clock::now() < deadline) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    service_.io.stop();
    thread_.join();
    service_.encoder.stop();
    service_.loader.stop();
    service_.encoder.join();
    service_.loader.join();
  }

  tcp::endpoint endpoint() const { return endpoint_; }
  std::size_t viewers() const { return service_.viewers; }
  bool loopback() const { return service_.loopback; }

 private:
  void listen() {
    const ServerOptions& options = service_.options;
    const tcp::endpoint local(address_of(options), options.port);
    ErrorCode error;
    acceptor_.open(local.protocol(), error);
    if (!error) acceptor_.set_option(asio::socket_base::reuse_address(true), error);
    if (!error) acceptor_.bind(local, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    if (error) fail(options, error);
    endpoint_ = acceptor_.local_endpoint();
    service_.loopback = endpoint_.address().is_loopback();
  }

  void accept() {
    acceptor_.async_accept([this](ErrorCode error, tcp::socket socket) {
      if (error == asio::error::operation_aborted || service_.closing) return;
      if (error) return accept_later();
      if (make_room()) start_http(service_, std::move(socket));
      accept();
    });
  }

  /// Slow clients must not keep others away: the oldest without request is closed, or with one
  /// where these are many, since clients may read nothing of their answers.
  bool make_room() {
    if (service_.connections + service_.viewers < kMaxConnections) return true;
    const bool has_many_answers = service_.answering.size() > kMaxConnections / 2;
    const auto& oldest =
        service_.waiting.empty() || has_many_answers ? service_.answering : service_.waiting;
    if (oldest.empty()) return false;
    oldest.front()->drop();
    return true;
  }

  void accept_later() {
    pause_.expires_after(kAcceptPause);
    pause_.async_wait([this](ErrorCode error) {
      if (!error) accept();
    });
  }

  /// Prevents map changes from accumulating without viewers.
  void apply_map_changes() {
    map_timer_.expires_after(kMapPeriod);
    map_timer_.async_wait([this](ErrorCode error) {
      if (error) return;
      asio::post(service_.encoder,
                 [this] { service_.scene->read_map([](const MapChunks&) { return 0; }); });
      apply_map_changes();
    });
  }

  Service service_;
  tcp::acceptor acceptor_;
  asio::steady_timer pause_;
  asio::steady_timer map_timer_;
  tcp::endpoint endpoint_;
  std::thread thread_;
};

ViewerServer::ViewerServer(const ServerOptions& options, std::shared_ptr<Scene> scene)
    : parts_(std::make_unique<Parts>(options, std::move(scene))) {}

ViewerServer::~ViewerServer() = default;

std::uint16_t ViewerServer::port() const {
  return parts_->endpoint().port();
}

std::string ViewerServer::url() const {
  const auto address = parts_->endpoint().address();
  const bool named = address.is_unspecified() || address.is_loopback();
  const std::string host = named             ? "localhost"
                           : address.is_v6() ? "[" + address.to_string() + "]"
                                             : address.to_string();
  return "http://" + host + ":" + std::to_string(port());
}

bool ViewerServer::is_open() const {
  return !parts_->loopback();
}

std::size_t ViewerServer::viewers() const {
  return parts_->viewers();
}

}  // namespace mms
