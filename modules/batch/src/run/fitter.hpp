// A child process that takes the step that jobs share, and then forks a process for each of them.
#pragma once

#include <string>

#include <bodice/batch/batch.hpp>

#include "manifest/manifest.hpp"
#include "process/process.hpp"
#include "results/result_store.hpp"

namespace bodice::inline v0_1::batch {

/// What a fitter needs of its batch.
struct FitterContext {
  Work& work;
  Manifest& manifest;
  const ResultStore& store;
  const BatchOptions& options;
};

/// The first message of a fitter is the outcome of the shared step. Then each line "ADDRESS KEY", with the
/// address of Manifest::address(), starts a job. {"line": ..., "computed": true} reports that its result
/// waits for the disk alone, and {"line": ..., "outcome": ...} its end. The line "end" kills jobs that
/// compute, publishes the others and ends the fitter. Never returns. Called in a process that was forked for
/// it.
[[noreturn]] void serve(const FitterContext& context, const Job& first, ChannelEnd channel, pid_t parent);

}  // namespace bodice::batch
