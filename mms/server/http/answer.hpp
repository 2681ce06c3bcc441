#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "mms/server/scene/scene.hpp"

namespace mms {

/// What a viewer asks for over HTTP.
struct Request {
  bool reads = true;  ///< GET or HEAD
  std::string target;
  std::string host;
  std::string origin;     ///< empty: none
  std::string known_tag;  ///< ETag of what the browser has; empty: nothing
  bool upgrades = false;  ///< wants to go on with WebSocket
};

/// What it gets. The body is `bytes`, `file` or `text`, the first of them that there is.
struct Answer {
  enum class Kind { kBytes, kFile, kLiveFile, kText, kWebSocket };

  Kind kind = Kind::kText;
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string cache = "no-store";
  std::string tag;         ///< ETag; empty: none
  std::string policy;      ///< Content-Security-Policy
  std::string_view bytes;  ///< of the program itself
  std::filesystem::path file;
  std::string live_file;      ///< name of a file that is to be written first
  std::string download_name;  ///< to be saved under; empty: to be shown
  std::string text;
};

/// @param loopback  whether the server is there for this machine alone
Answer answer_to(const Request& request, const Scene& scene, bool loopback);

/// An answer that is one line of text.
Answer text_answer(int status, std::string text);

}  // namespace mms
