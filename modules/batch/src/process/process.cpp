#include "process/process.hpp"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <new>
#include <utility>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace bodice::inline v0_1::batch {
namespace {

/// The state of a child process, which runs one job and ends: the allocator has no other channel for it.
bool ran_out = false;

double cpu_s_of(const rusage& usage) {
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

[[noreturn]] void run_out_of_memory() {
  ran_out = true;
  throw std::bad_alloc();
}

}  // namespace

ChannelEnd& ChannelEnd::operator=(ChannelEnd&& other) noexcept {
  if (this != &other) close(), descriptor_ = other.release();
  return *this;
}

int ChannelEnd::release() {
  return std::exchange(descriptor_, -1);
}

void ChannelEnd::close() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

Channel make_channel() {
  int ends[2] = {-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return {};
  return {ChannelEnd(ends[0]), ChannelEnd(ends[1])};
}

bool send_line(int descriptor, std::string_view line) {
  std::string text(line);
  text += '\n';
  for (std::string_view rest = text; !rest.empty();) {
    const ssize_t count = ::send(descriptor, rest.data(), rest.size(), MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    rest.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

bool LineReader::read_from(int descriptor) {
  char chunk[4096];
  ssize_t count;
  do count = ::read(descriptor, chunk, sizeof chunk);
  while (count < 0 && errno == EINTR);
  if (count <= 0) return false;
  text_.append(chunk, static_cast<std::size_t>(count));
  return true;
}

std::optional<std::string> LineReader::next() {
  const std::size_t end = text_.find('\n');
  if (end == std::string::npos) return std::nullopt;
  std::string line = text_.substr(0, end);
  text_.erase(0, end + 1);
  return line;
}

void become_child(pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // the parent ended before the line above
  for (const int ignored : {SIGINT, SIGTERM, SIGHUP}) std::signal(ignored, SIG_IGN);
  for (const int fatal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL}) std::signal(fatal, SIG_DFL);
  const int score = ::open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
  if (score < 0) return;
  [[maybe_unused]] const ssize_t written = ::write(score, "800", 3);
  ::close(score);
}

void limit_memory(double memory_mb) {
  std::set_new_handler(run_out_of_memory);
  if (memory_mb <= 0.0) return;
  const rlimit limit{static_cast<rlim_t>(memory_mb * 1e6), static_cast<rlim_t>(memory_mb * 1e6)};
  ::setrlimit(RLIMIT_DATA, &limit);
}

bool memory_ran_out() {
  return ran_out;
}

bool Ending::by_itself() const {
  return WIFEXITED(status);
}

int Ending::signal() const {
  return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

Ending wait_for(pid_t process) {
  Ending ending;
  rusage usage = {};
  while (::wait4(process, &ending.status, 0, &usage) < 0 && errno == EINTR) {
  }
  ending.memory_mb = static_cast<double>(usage.ru_maxrss) * 1024e-6;
  ending.cpu_s = cpu_s_of(usage);
  return ending;
}

std::string signal_name(int signal) {
  const char* const name = ::sigabbrev_np(signal);
  return name ? std::string("SIG") + name : "signal " + std::to_string(signal);
}

double own_cpu_s() {
  rusage usage = {};
  ::getrusage(RUSAGE_SELF, &usage);
  return cpu_s_of(usage);
}

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace bodice::batch
