#pragma once

// Internal to server.

#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>

#include "mms/server/http/service.hpp"

namespace mms {

/// Upgrades a connection to a viewer's WebSocket, which exists until the viewer disconnects.
void start_viewer(Service& service, boost::beast::tcp_stream stream,
                  boost::beast::http::request<boost::beast::http::string_body> request);

}  // namespace mms
