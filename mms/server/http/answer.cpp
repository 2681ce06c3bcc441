#include "mms/server/http/answer.hpp"

#include <utility>

#include "mms/io/journal/crc32.hpp"
#include "mms/server/http/origin.hpp"
#include "mms/server/http/page.hpp"
#include "mms/server/scene/downloads.hpp"

namespace mms {
namespace {

constexpr std::string_view kFiles = "/files/";

/// Allows only resources of this server, and no inline scripts.
std::string page_policy(const std::string& host) {
  return "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
         "font-src 'self'; connect-src 'self' ws://" +
         host + " wss://" + host +
         "; worker-src 'self' blob:; manifest-src 'self'; base-uri 'none'; form-action 'none'; "
         "frame-ancestors 'none'";
}

/// A report has inline style and images, and no scripts.
constexpr const char* kFilePolicy =
    "default-src 'none'; style-src 'unsafe-inline'; img-src data:; sandbox";

/// Whether the Host is valid in a header: a name or address and a port.
bool is_plain_host(std::string_view host) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-_:[]";
  return !host.empty() && host.find_first_not_of(kPlain) == std::string_view::npos;
}

std::string tag_of(std::string_view bytes) {
  std::string tag(1, '"');
  tag += std::to_string(crc32(bytes)) + "-" + std::to_string(bytes.size());
  return tag + '"';
}

Answer page_answer(std::string_view path, const Request& request) {
  const PageFile* file = find_page_file(path);
  if (file == nullptr) {
    return text_answer(
        404, page_files().empty() ? "this mms was built without the viewer page" : "not found");
  }
  Answer answer;
  answer.kind = Answer::Kind::kBytes;
  answer.type = mime_type(file->path);
  answer.cache = "no-cache";  // revalidated by its tag
  answer.tag = tag_of(file->bytes);
  answer.policy = page_policy(request.host);
  answer.bytes = file->bytes;
  if (request.known_tag != answer.tag) return answer;
  answer.status = 304;
  answer.bytes = {};
  return answer;
}

Answer file_answer(std::string_view name, const Scene& scene) {
  Answer answer;
  answer.type = mime_type(name);
  answer.policy = kFilePolicy;
  if (name != "report.html") answer.download_name = name;
  const std::filesystem::path folder = scene.folder();
  if (folder.empty()) {
    if (!is_live_download(name)) return text_answer(404, "the run has no such file yet");
    answer.kind = Answer::Kind::kLiveFile;
    answer.live_file = name;
    return answer;
  }
  const auto path = find_download(folder, name);
  if (!path) return text_answer(404, "the run has no such file");
  answer.kind = Answer::Kind::kFile;
  answer.file = *path;
  return answer;
}

Answer web_socket_answer(const Request& request) {
  if (!request.upgrades) return text_answer(426, "this address requires WebSocket");
  Answer answer;
  answer.kind = Answer::Kind::kWebSocket;
  return answer;
}

}  // namespace

Answer text_answer(int status, std::string text) {
  Answer answer;
  answer.status = status;
  answer.policy = "default-src 'none'";
  answer.text = std::move(text) + "\n";
  return answer;
}

Answer answer_to(const Request& request, const Scene& scene, bool loopback) {
  if (!is_plain_host(request.host))
    return text_answer(400, "the Host header is missing or invalid");
  if (loopback && !is_loopback_name(request.host)) {
    return text_answer(403, "this server only answers to localhost");
  }
  if (!is_own_origin(request.origin, request.host)) {
    return text_answer(403, "requests from pages of other origins are rejected");
  }
  if (!request.reads) return text_answer(405, "only GET and HEAD are allowed");
  const std::string_view target = request.target;
  const std::string_view path = target.substr(0, target.find_first_of("?#"));
  if (path == "/ws") return web_socket_answer(request);
  if (path.starts_with(kFiles)) return file_answer(path.substr(kFiles.size()), scene);
  return page_answer(path, request);
}

}  // namespace mms
