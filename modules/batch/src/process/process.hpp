// Child processes: lines through channels, limits, and how a process ended.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <sys/types.h>

namespace bodice::inline v0_1::batch {

/// One end of a channel, closed with the object.
class ChannelEnd {
 public:
  ChannelEnd() = default;
  explicit ChannelEnd(int descriptor) : descriptor_(descriptor) {}
  ChannelEnd(ChannelEnd&& other) noexcept : descriptor_(other.release()) {}
  ChannelEnd& operator=(ChannelEnd&& other) noexcept;
  ~ChannelEnd() { close(); }
  int descriptor() const { return descriptor_; }
  int release();
  void close();

 private:
  int descriptor_ = -1;
};

/// Two connected ends, of which a child process keeps one. Lines go both directions.
struct Channel {
  ChannelEnd ours, theirs;
  explicit operator bool() const { return ours.descriptor() >= 0; }
};

/// Without ends where the system has no descriptors left.
Channel make_channel();

/// Sends the text and a line end as a whole. Returns false if the other process is gone.
bool send_line(int descriptor, std::string_view line);

/// Splits what a channel gives into lines.
class LineReader {
 public:
  /// Reads once, after poll() has found something. Returns false at the end.
  bool read_from(int descriptor);
  std::optional<std::string> next();

 private:
  std::string text_;
};

/// What a child process does first: it ends with its parent, does not hear the terminal's signals, and is the
/// first to go where the machine runs out of memory.
void become_child(pid_t parent);

/// Limits the data of this process and of the processes it forks, in 10^6 bytes. Allocations beyond it throw
/// std::bad_alloc, and memory_ran_out() is true from then on.
void limit_memory(double memory_mb);
bool memory_ran_out();

/// How a process ended.
struct Ending {
  int status = 0;
  double memory_mb = 0.0;  ///< most resident memory
  double cpu_s = 0.0;      ///< seconds of all cores
  bool by_itself() const;
  int signal() const;  ///< 0 where it ended by itself
};

/// Waits for the process and removes it from the system's table.
Ending wait_for(pid_t process);

/// "SIGSEGV" and the like.
std::string signal_name(int signal);

/// Seconds of a clock that only goes forward.
double now_s();

/// Seconds of all cores that this process has used.
double own_cpu_s();

}  // namespace bodice::batch
