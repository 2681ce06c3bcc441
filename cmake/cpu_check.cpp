// Ends the program with one message on a processor older than its target, instead of SIGILL.
// Compiled for the oldest processor and run before any other code: the .preinit_array precedes the
// constructors of all libraries.
#include <unistd.h>

namespace {

constexpr char kMessage[] =
    "error: this program requires " MMS_CPU_LEVEL
    " processors, but this one lacks instructions of that level (such as " MMS_CPU_EXAMPLE
    "); build it from source with -DMMS_ARCH=" MMS_CPU_FALLBACK "\n";

void check_cpu() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports(MMS_CPU_LEVEL)) return;
  // A failed write cannot be handled here.
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kMessage, sizeof(kMessage) - 1);
  _exit(1);
}

[[gnu::section(".preinit_array"), gnu::used]] void (*const kCheck)() = check_cpu;

}  // namespace
