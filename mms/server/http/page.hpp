#pragma once

#include <span>
#include <string_view>

namespace mms {

/// A file of the viewer's page, which is part of the program.
struct PageFile {
  std::string_view path;  ///< as it is asked for: "/index.html", "/assets/index-1a2b3c.js"
  std::string_view bytes;
};

/// All of them; made by CMake of viewer/dist.
std::span<const PageFile> page_files();

/// The file at a path, "/" being index.html; null where there is none.
const PageFile* find_page_file(std::string_view path);

/// "text/html; charset=utf-8" of "x.html"; application/octet-stream where it is not known.
std::string_view mime_type(std::string_view path);

}  // namespace mms
