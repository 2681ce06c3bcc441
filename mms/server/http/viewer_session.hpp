#pragma once

// Internal to server.

#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>

#include "mms/server/http/service.hpp"

namespace mms {

/// Goes on with a connection as a viewer's WebSocket, which lives as long as the viewer stays.
void start_viewer(Service& service, boost::beast::tcp_stream stream,
                  boost::beast::http::request<boost::beast::http::string_body> request);

}  // namespace mms
