#include "mms/map_file/map_claim.hpp"

#include <mutex>
#include <set>
#include <system_error>

#include "mms/core/error.hpp"

namespace mms {

namespace fs = std::filesystem;

namespace {

struct Claims {
  std::mutex mutex;
  std::set<fs::path> paths;
};

/// Of this process.
Claims& claims() {
  static Claims all;
  return all;
}

/// The same for all names of a file, through links, too.
fs::path real_path(const fs::path& path) {
  std::error_code error;
  fs::path real = fs::weakly_canonical(path, error);
  return error ? path : real;
}

}  // namespace

MapClaim::MapClaim(const fs::path& path) : path_(real_path(path)) {
  const std::scoped_lock lock(claims().mutex);
  if (claims().paths.insert(path_).second) return;
  throw FileError(path.string(), "is in use by this program",
                  "end the run that writes it (Python: del slam), or choose another file");
}

MapClaim::~MapClaim() {
  const std::scoped_lock lock(claims().mutex);
  claims().paths.erase(path_);
}

bool MapClaim::exists(const fs::path& path) {
  const fs::path real = real_path(path);
  const std::scoped_lock lock(claims().mutex);
  return claims().paths.contains(real);
}

}  // namespace mms
