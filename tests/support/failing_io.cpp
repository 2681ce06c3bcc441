// A library for LD_PRELOAD, for benchmarks/faults.sh: lets calls for regular files fail.
//   MMS_FAIL=write|short|open   what fails: writes, all but one byte of them, or opening files
//   MMS_FAIL_AT=N               the first call that fails, from 1
//   MMS_FAIL_COUNT=N            how many fail (default: all from there on)
//   MMS_FAIL_ERRNO=N            the error (default: ENOSPC)
//   MMS_FAIL_FILE=TEXT          only writes to files with this in their path (default: to all)

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

long number(const char* name, long otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::atol(text);
}

bool is(const char* kind) {
  const char* chosen = std::getenv("MMS_FAIL");
  return chosen != nullptr && std::strcmp(chosen, kind) == 0;
}

/// Counts a call; whether it has to fail.
bool fails(const char* kind) {
  static std::atomic<long> calls = 0;
  if (!is(kind)) return false;
  const long call = ++calls;
  const long first = number("MMS_FAIL_AT", 1);
  return call >= first && call - first < number("MMS_FAIL_COUNT", 1'000'000'000);
}

int error() {
  return static_cast<int>(number("MMS_FAIL_ERRNO", ENOSPC));
}

/// Whether the descriptor is that of a regular file whose writes are to fail.
bool is_meant(int descriptor) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return false;
  const char* part = std::getenv("MMS_FAIL_FILE");
  if (part == nullptr) return true;
  char path[4096] = {};
  const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
  return readlink(link.c_str(), path, sizeof path - 1) > 0 && std::strstr(path, part) != nullptr;
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

/// Files of the system and its libraries are opened as always.
bool is_ours(const char* path) {
  for (const char* system : {"/proc", "/sys", "/dev", "/lib", "/usr", "/etc"}) {
    if (std::strncmp(path, system, std::strlen(system)) == 0) return false;
  }
  return true;
}

int open_with(const char* name, const char* path, int flags, mode_t mode) {
  if (is_ours(path) && fails("open")) return errno = error(), -1;
  return next<int (*)(const char*, int, mode_t)>(name)(path, flags, mode);
}

std::FILE* fopen_with(const char* name, const char* path, const char* mode) {
  if (is_ours(path) && fails("open")) return errno = error(), nullptr;
  return next<std::FILE* (*)(const char*, const char*)>(name)(path, mode);
}

/// SQLite's writes.
ssize_t write_at(const char* name, int descriptor, const void* bytes, size_t size, off64_t at) {
  const auto real = next<ssize_t (*)(int, const void*, size_t, off64_t)>(name);
  if (is_meant(descriptor)) {
    if (fails("write")) return errno = error(), -1;
    if (size > 1 && fails("short")) return real(descriptor, bytes, 1, at);
  }
  return real(descriptor, bytes, size, at);
}

mode_t mode_of(int flags, va_list arguments) {
  return (flags & O_CREAT) != 0 ? va_arg(arguments, mode_t) : 0;
}

}  // namespace

extern "C" {

ssize_t write(int descriptor, const void* bytes, size_t size) {
  const auto real = next<ssize_t (*)(int, const void*, size_t)>("write");
  if (is_meant(descriptor)) {
    if (fails("write")) return errno = error(), -1;
    if (size > 1 && fails("short")) return real(descriptor, bytes, 1);
  }
  return real(descriptor, bytes, size);
}

ssize_t writev(int descriptor, const iovec* parts, int count) {
  if (is_meant(descriptor)) {
    if (fails("write")) return errno = error(), -1;
    int first = 0;
    while (first < count && parts[first].iov_len == 0) ++first;
    if (first < count && fails("short")) {
      return next<ssize_t (*)(int, const void*, size_t)>("write")(descriptor, parts[first].iov_base,
                                                                  1);
    }
  }
  return next<ssize_t (*)(int, const iovec*, int)>("writev")(descriptor, parts, count);
}

ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t at) {
  return write_at("pwrite", descriptor, bytes, size, at);
}

ssize_t pwrite64(int descriptor, const void* bytes, size_t size, off64_t at) {
  return write_at("pwrite64", descriptor, bytes, size, at);
}

int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_of(flags, arguments);
  va_end(arguments);
  return open_with("open", path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_of(flags, arguments);
  va_end(arguments);
  return open_with("open64", path, flags, mode);
}

std::FILE* fopen(const char* path, const char* mode) {
  return fopen_with("fopen", path, mode);
}

std::FILE* fopen64(const char* path, const char* mode) {
  return fopen_with("fopen64", path, mode);
}
}
