#pragma once

// Internal to server.

#include <boost/beast/core/tcp_stream.hpp>

#include "mms/server/http/service.hpp"

namespace mms {

/// Answers the requests of a connection until it is closed, stands still for too long or becomes a
/// viewer's WebSocket.
void start_http(Service& service, boost::asio::ip::tcp::socket socket);

}  // namespace mms
