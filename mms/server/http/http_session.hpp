#pragma once

// Internal to server.

#include <boost/beast/core/tcp_stream.hpp>

#include "mms/server/http/service.hpp"

namespace mms {

/// Answers the requests of a connection until it is closed, times out or becomes a WebSocket.
void start_http(Service& service, boost::asio::ip::tcp::socket socket);

}  // namespace mms
