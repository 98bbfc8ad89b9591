#include "import/source/try_reading.hpp"

#if defined(__unix__) && !defined(__EMSCRIPTEN__)
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#endif

namespace bodice::inline v0_1::io {

#if defined(__unix__) && !defined(__EMSCRIPTEN__)

namespace {

/// Time beyond `most_s`, on a busy machine, after which a child is taken to wait for a lock that another
/// thread held when it was copied.
constexpr unsigned kLocked_s = 100;

void limit(int resource, rlim_t most) {
  rlimit now{};
  if (::getrlimit(resource, &now) != 0) return;
  if (now.rlim_max == RLIM_INFINITY || most < now.rlim_max) now.rlim_cur = most;
  ::setrlimit(resource, &now);
}

[[noreturn]] void run_child(const std::function<void()>& function, unsigned most_s) {
  for (const int fatal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGALRM, SIGXCPU})
    std::signal(fatal, SIG_DFL);
  // A host that handles signals in a thread of its own blocks them in all others, and a child inherits that.
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, most_s);
  ::alarm(most_s + kLocked_s);
  if (const int nothing = ::open("/dev/null", O_WRONLY | O_CLOEXEC); nothing >= 0) {
    ::dup2(nothing, STDOUT_FILENO);
    ::dup2(nothing, STDERR_FILENO);
  }
  try {
    function();
  } catch (...) {
    ::_exit(EXIT_FAILURE);
  }
  ::_exit(EXIT_SUCCESS);
}

}  // namespace

Ending try_in_child(const std::function<void()>& function, unsigned most_s) {
  const pid_t child = ::fork();
  if (child < 0) return Ending::kEnds;
  if (child == 0) run_child(function, most_s);
  int status = 0;
  pid_t ended;
  do ended = ::waitpid(child, &status, 0);
  while (ended < 0 && errno == EINTR);
  if (ended < 0) return Ending::kEnds;  // a host that ignores its children
  if (WIFEXITED(status)) return WEXITSTATUS(status) == EXIT_SUCCESS ? Ending::kEnds : Ending::kCrashes;
  const int signal = WTERMSIG(status);
  if (signal == SIGXCPU) return Ending::kRunsOn;
  return signal == SIGALRM || signal == SIGKILL || signal == SIGTERM ? Ending::kEnds : Ending::kCrashes;
}

#else

Ending try_in_child(const std::function<void()>&, unsigned) {
  return Ending::kEnds;
}

#endif

}  // namespace bodice::io
