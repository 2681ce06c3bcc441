#include "mms/io/text/temporary_path.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <random>
#include <utility>

namespace mms {
namespace {

// Paths beyond this number are not removed by signals; a run has fewer than ten at a time.
std::array<std::atomic<char*>, 64> temporary_paths{};
// Of these, those that a signal removed. They are not freed: handlers must not.
std::array<std::atomic<char*>, 64> removed_paths{};
static_assert(std::atomic<char*>::is_always_lock_free, "signal handlers must not lock");

}  // namespace

std::string process_mark() {
  static const std::uint32_t kNumber = std::random_device{}();
  return std::to_string(::getpid()) + std::to_string(kNumber);
}

TemporaryPath::TemporaryPath(std::filesystem::path path) : path_(std::move(path)) {
  char* copy = strdup(path_.c_str());
  for (auto& place : temporary_paths) {
    char* expected = nullptr;
    if (!place.compare_exchange_strong(expected, copy)) continue;
    registered_ = copy;
    return;
  }
  std::free(copy);
}

TemporaryPath::~TemporaryPath() {
  if (path_.empty()) return;
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
  release();
}

void TemporaryPath::release() {
  for (auto& place : temporary_paths) {
    char* expected = registered_;
    if (registered_ == nullptr || !place.compare_exchange_strong(expected, nullptr)) continue;
    std::free(registered_);
    break;
  }
  registered_ = nullptr;
  path_.clear();
}

void remove_temporary_paths() noexcept {
  for (std::size_t i = 0; i < temporary_paths.size(); ++i) {
    char* path = temporary_paths[i].exchange(nullptr);
    if (path == nullptr) continue;
    unlink(path);
    removed_paths[i] = path;
  }
  for (const std::atomic<char*>& removed : removed_paths) {
    if (const char* path = removed; path != nullptr) rmdir(path);
  }
}

}  // namespace mms
