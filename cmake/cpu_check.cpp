// Ends the program with one sentence on a processor older than the one it was compiled for, in
// place of SIGILL. Compiled for the oldest processor, and run before any other code of the program:
// the .preinit_array comes before the constructors of all libraries.
#include <unistd.h>

namespace {

constexpr char kMessage[] =
    "error: this program is built for " MMS_CPU_LEVEL
    " processors, but this one lacks instructions of that level (such as " MMS_CPU_EXAMPLE
    "); build it from source with -DMMS_ARCH=" MMS_CPU_FALLBACK "\n";

void check_cpu() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports(MMS_CPU_LEVEL)) return;
  // Nothing can be done about a failed write here.
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kMessage, sizeof(kMessage) - 1);
  _exit(1);
}

[[gnu::section(".preinit_array"), gnu::used]] void (*const kCheck)() = check_cpu;

}  // namespace
