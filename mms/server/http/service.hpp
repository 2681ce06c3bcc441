#pragma once

// Internal to server: shared state of all connections. The only headers that include Boost are
// this, http_session.hpp and viewer_session.hpp.

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/thread_pool.hpp>
#include <list>
#include <memory>

#include "mms/server/http/server.hpp"
#include "mms/server/scene/picture_cache.hpp"
#include "mms/server/scene/viewer_scene.hpp"

namespace mms {

/// A connection that is not a viewer's WebSocket.
class Connection {
 public:
  virtual ~Connection() = default;
  virtual void drop() = 0;  ///< closes it
};

/// Sockets run in the thread of `io`, messages are encoded in `encoder`, and images, which take
/// longer, in `loader`, so that neither blocks the sockets.
struct Service {
  Service(const ServerOptions& given, std::shared_ptr<Scene> shown)
      : options(given), scene(std::move(shown)), pictures(*scene) {}

  ServerOptions options;
  std::shared_ptr<Scene> scene;
  PictureCache pictures;  // of the loader's thread
  bool loopback = true;
  std::atomic<bool> closing = false;
  std::atomic<std::size_t> viewers = 0;
  std::atomic<std::size_t> connections = 0;
  // Of the thread of `io`, the oldest first.
  std::list<Connection*> waiting;    ///< for a request
  std::list<Connection*> answering;  ///< a request
  boost::asio::io_context io{1};
  boost::asio::thread_pool encoder{1};
  boost::asio::thread_pool loader{1};
};

}  // namespace mms
