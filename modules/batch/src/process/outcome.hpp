// How an attempt at a job, or at the step that jobs share, ended.
#pragma once

#include <string>

#include <bodice/batch/work.hpp>
#include <bodice/engine/json.hpp>

#include "process/process.hpp"

namespace bodice::inline v0_1::batch {

/// Why an attempt failed. Only the last four are worth another attempt: errors of the work repeat.
enum class Failure { kNone, kError, kWrite, kCrash, kKilled, kTimeout, kMemory };

/// The words of the log: "error", "write", "crash", "killed", "timeout", "memory"; "none".
std::string name(Failure failure);
Failure failure_from_name(const std::string& name);
bool may_differ_next_time(Failure failure);

/// What processes send each other about an attempt.
struct Outcome {
  Failure failure = Failure::kNone;
  bool there = false;  ///< another process had published the result first
  std::string reason;  ///< why it failed, in a sentence
  double seconds = 0.0, cpu_s = 0.0, memory_mb = 0.0;
  engine::SortedJson facts = engine::SortedJson::object();  ///< seed, warnings, numbers
};

engine::SortedJson json_of(const Outcome& outcome);
Outcome outcome_from(const engine::SortedJson& json);
engine::SortedJson json_of(const JobFacts& facts);

/// One line, in which bytes that are no UTF-8, as of file names, are replaced.
std::string one_line(const engine::SortedJson& value);

Outcome outcome_of(const engine::Error& error);
/// The outcome for a process that ended without one of its own. `limit_mb` (0: none) is what its memory was
/// limited to.
Outcome outcome_of(const Ending& ending, double limit_mb);
Outcome outcome_of_timeout(double timeout_s);
Outcome outcome_of_memory(double limit_mb);

/// Runs `attempt`, which gives an Outcome, and makes outcomes of what it throws.
template <class Attempt>
Outcome guarded(double limit_mb, Attempt attempt) {
  const double begin_s = now_s();
  Outcome outcome;
  try {
    outcome = attempt();
  } catch (const std::bad_alloc&) {
    outcome = outcome_of_memory(limit_mb);
  } catch (const std::exception& error) {
    outcome = outcome_of(engine::Error{engine::ErrorCode::kInternal,
                                       std::string("Unexpected failure: ") + error.what() + ".", ""});
  }
  // Libraries turn a failed allocation into errors of their own.
  if (outcome.failure != Failure::kNone && memory_ran_out()) outcome = outcome_of_memory(limit_mb);
  outcome.seconds = now_s() - begin_s;
  outcome.cpu_s = own_cpu_s();
  return outcome;
}

}  // namespace bodice::batch
