// Readers that crash on damaged files do so in a process of their own.
#include <doctest/doctest.h>

#include <csignal>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <stdexcept>

#include "import/source/try_reading.hpp"

using namespace bodice;
using io::Ending;

namespace {

Ending try_in_child(const std::function<void()>& function) {
  return io::try_in_child(function, 1);
}

// Never returns. The clock is read because a compiler may remove a loop that does nothing.
void run_forever() {
  for (;;) std::clock();
}

}  // namespace

TEST_CASE("a function that crashes, aborts or throws in a child leaves this process as it was") {
  int calls = 0;
  CHECK(try_in_child([&] { ++calls; }) == Ending::kEnds);
  CHECK(try_in_child([] { std::raise(SIGSEGV); }) == Ending::kCrashes);
  CHECK(try_in_child([] { std::abort(); }) == Ending::kCrashes);
  CHECK(try_in_child([] { throw std::runtime_error("damaged"); }) == Ending::kCrashes);
  CHECK(calls == 0);
}

TEST_CASE("a function that takes more processor time than it may in a child runs on") {
  CHECK(try_in_child(run_forever) == Ending::kRunsOn);
}

TEST_CASE("a child that was stopped by others, or waits for a lock, is no evidence against the file") {
  for (const int signal : {SIGALRM, SIGKILL, SIGTERM})
    CHECK(try_in_child([=] { std::raise(signal); }) == Ending::kEnds);
}

TEST_CASE("a function that takes too long runs on in a child of a thread that blocks all signals, too") {
  sigset_t all, before;
  ::sigfillset(&all);
  REQUIRE(::pthread_sigmask(SIG_SETMASK, &all, &before) == 0);
  const Ending ending = try_in_child(run_forever);
  REQUIRE(::pthread_sigmask(SIG_SETMASK, &before, nullptr) == 0);
  CHECK(ending == Ending::kRunsOn);
}
