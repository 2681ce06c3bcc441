#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "mms/server/scene/viewer_scene.hpp"

namespace mms {

/// An HTTP request of a viewer.
struct Request {
  bool reads = true;  ///< GET or HEAD
  std::string target;
  std::string host;
  std::string origin;     ///< empty if absent
  std::string known_tag;  ///< ETag of the browser's copy; empty if none
  bool upgrades = false;  ///< requests an upgrade to WebSocket
};

/// The response. The body is `bytes`, `file` or `text`, the first that is not empty.
struct Answer {
  enum class Kind { kBytes, kFile, kLiveFile, kText, kWebSocket };

  Kind kind = Kind::kText;
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string cache = "no-store";
  std::string tag;         ///< ETag; empty if none
  std::string policy;      ///< Content-Security-Policy
  std::string_view bytes;  ///< part of the program
  std::filesystem::path file;
  std::string live_file;      ///< name of a file to write before sending
  std::string download_name;  ///< file name for saving; empty: display
  std::string text;
};

/// @param loopback  whether the server only listens on loopback
Answer answer_to(const Request& request, const Scene& scene, bool loopback);

/// A response with one line of text.
Answer text_answer(int status, std::string text);

}  // namespace mms
