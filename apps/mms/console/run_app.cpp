#include "apps/mms/console/run_app.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <string>

#include "apps/mms/console/interrupt.hpp"
#include "apps/mms/console/standard_streams.hpp"
#include "apps/mms/console/usage.hpp"
#include "apps/mms/console/warnings.hpp"
#include "mms/core/error.hpp"

namespace mms {
namespace {

constexpr int kFault = 1;
constexpr int kUsage = 2;
constexpr int kInterrupted = 130;

int fail(const std::string& what, int exit_code = kFault) {
  fmt::print(stderr, "mms: {}\n", printable(what));
  return exit_code;
}

}  // namespace

int run_app(CLI::App& app, int argc, char** argv) {
  handle_interrupts();
  std::cerr.rdbuf(nullptr);  // OpenCV prints the faults of images there, which we report
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool asked = error.get_exit_code() == 0;  // --help or --version
    if (!asked) return fail(usage_fault(app, error), kUsage);
    app.exit(error);
  } catch (const Interrupted& error) {
    return fail(error.what(), kInterrupted);
  } catch (const Error& error) {
    return fail(error.what());
  } catch (const std::bad_alloc&) {
    return fail("out of memory (use less data with --frames, or a larger static_map.voxel_size)");
  } catch (const std::exception& error) {
    return fail(error.what());
  }
  if (flush_output()) return 0;
  return fail(std::string("standard output cannot be written: ") + std::strerror(errno));
}

}  // namespace mms
