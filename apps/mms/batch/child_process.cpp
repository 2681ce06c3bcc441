#include "apps/mms/batch/child_process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

#include "apps/mms/console/interrupt.hpp"
#include "mms/core/error.hpp"

namespace mms {
namespace {

constexpr int kCannotRun = 127;  // exit status, as of shells
constexpr int kOfSignal = 128;

/// Of the child, between fork and exec: only calls that are safe there.
[[noreturn]] void become(char* const* arguments, int input, int output, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() == parent && dup2(input, STDIN_FILENO) >= 0 && dup2(output, STDOUT_FILENO) >= 0 &&
      dup2(output, STDERR_FILENO) >= 0) {
    execv("/proc/self/exe", arguments);
  }
  _exit(kCannotRun);
}

int wait_for(pid_t child) {
  bool told = false;
  while (true) {
    if (InterruptGuard::requested() && !told) {
      kill(child, SIGTERM);  // Ctrl-C reaches it by itself, a signal to this process alone does not
      told = true;
    }
    int status = 0;
    constexpr useconds_t kPeriod = 50'000;  // [us]
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) {
      return WIFEXITED(status) ? WEXITSTATUS(status) : kOfSignal + WTERMSIG(status);
    }
    if (ended < 0 && errno != EINTR) return kCannotRun;
    usleep(kPeriod);
  }
}

}  // namespace

int run_self(const std::vector<std::string>& arguments, const std::filesystem::path& log) {
  constexpr int kMode = 0644;
  const int input = open("/dev/null", O_RDONLY | O_CLOEXEC);
  const int output = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kMode);
  if (output < 0) {
    close(input);
    throw FileError(log.string(), "cannot be written");
  }
  std::vector<std::string> words = {"mms"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) become(pointers.data(), input, output, parent);
  close(input);
  close(output);
  if (child < 0) throw FileError(arguments.front(), "no process can be made for it");
  return wait_for(child);
}

}  // namespace mms
