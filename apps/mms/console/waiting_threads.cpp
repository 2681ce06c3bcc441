#include "apps/mms/console/waiting_threads.hpp"

#include <unistd.h>

#include <cstdlib>

namespace mms {

void let_waiting_threads_sleep(char** argv) {
  constexpr const char* kPolicy = "OMP_WAIT_POLICY";
  if (std::getenv(kPolicy) != nullptr) return;
  if (setenv(kPolicy, "passive", 1) != 0) return;
  execv("/proc/self/exe", argv);  // returns only on failure; then the threads spin
}

}  // namespace mms
