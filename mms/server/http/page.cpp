#include "mms/server/http/page.hpp"

#include <array>
#include <utility>

namespace mms {

const PageFile* find_page_file(std::string_view path) {
  if (path == "/") path = "/index.html";
  for (const PageFile& file : page_files()) {
    if (file.path == path) return &file;
  }
  return nullptr;
}

std::string_view mime_type(std::string_view path) {
  using Entry = std::pair<std::string_view, std::string_view>;
  constexpr std::array<Entry, 17> kTypes = {{{".html", "text/html; charset=utf-8"},
                                             {".js", "text/javascript; charset=utf-8"},
                                             {".css", "text/css; charset=utf-8"},
                                             {".json", "application/json"},
                                             {".webmanifest", "application/manifest+json"},
                                             {".svg", "image/svg+xml"},
                                             {".png", "image/png"},
                                             {".jpg", "image/jpeg"},
                                             {".ico", "image/x-icon"},
                                             {".woff2", "font/woff2"},
                                             {".wasm", "application/wasm"},
                                             {".txt", "text/plain; charset=utf-8"},
                                             {".tum", "text/plain; charset=utf-8"},
                                             {".csv", "text/csv; charset=utf-8"},
                                             {".yaml", "text/plain; charset=utf-8"},
                                             {".pgm", "image/x-portable-graymap"},
                                             {".map", "application/json"}}};
  for (const auto& [extension, type] : kTypes) {
    if (path.ends_with(extension)) return type;
  }
  return "application/octet-stream";
}

}  // namespace mms
