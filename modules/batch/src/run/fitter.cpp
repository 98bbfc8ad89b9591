#include "run/fitter.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <list>
#include <optional>

#include <poll.h>
#include <unistd.h>

#include <bodice/engine/write_file.hpp>

#include "process/outcome.hpp"

namespace bodice::inline v0_1::batch {
namespace {

namespace fs = std::filesystem;
using engine::SortedJson;

/// A job in a process of its own, and then its result in another one that waits for the disk.
struct Running {
  pid_t process = -1;
  ChannelEnd channel;
  LineReader reader;
  std::size_t line = 0;
  std::string key;
  fs::path part;
  double begin_s = 0.0;
  std::optional<Outcome> outcome;  ///< as the process sent it
  bool late = false;
  bool computed = false;  ///< its result is being published
};

class Fitter {
 public:
  Fitter(const FitterContext& context, ChannelEnd channel)
      : context_(context), channel_(std::move(channel)) {}

  void serve(const Job& first) {
    const Outcome prepared = guarded(limit_mb(), [&] { return prepare(first); });
    fit_s_ = prepared.seconds;
    if (!send_line(channel_.descriptor(), one_line(json_of(prepared)))) return;
    if (prepared.failure != Failure::kNone) return;
    while (listen()) {
    }
    for (Running& job : running_)
      if (!job.computed) ::kill(job.process, SIGKILL);
    for (Running& job : running_) wait_for(job.process), ResultStore::discard(job.part);
  }

 private:
  double limit_mb() const { return context_.options.memory_mb; }

  Outcome prepare(const Job& first) {
    auto prepared = context_.work.prepare(first);
    if (!prepared) return outcome_of(prepared.error());
    prepared_ = std::move(prepared).value();
    return {};
  }

  /// Waits for the next event. Returns false at the end.
  bool listen() {
    std::vector<pollfd> watched = {{channel_.descriptor(), POLLIN, 0}};
    for (const Running& job : running_) watched.push_back({job.channel.descriptor(), POLLIN, 0});
    ::poll(watched.data(), watched.size(), wait_ms());
    auto seen = watched.begin() + 1;
    for (auto job = running_.begin(); job != running_.end(); ++seen) {
      const auto current = job++;
      if (seen->revents != 0 && !hear(*current)) finish(current);
    }
    stop_late_jobs();
    if (watched.front().revents == 0) return true;
    if (!commands_.read_from(channel_.descriptor())) return false;
    while (const auto command = commands_.next()) {
      if (*command == "end") return false;
      start(*command);
    }
    return true;
  }

  /// Milliseconds to the next deadline; -1 without one.
  int wait_ms() const {
    double left_s = -1.0;
    if (context_.options.timeout_s > 0.0)
      for (const Running& job : running_)
        if (!job.late && !job.computed) {
          const double job_left_s = std::max(0.0, deadline_s(job) - now_s());
          left_s = left_s < 0.0 ? job_left_s : std::min(left_s, job_left_s);
        }
    return left_s < 0.0 ? -1 : static_cast<int>(std::min(1e6, std::ceil(1e3 * left_s)));
  }

  /// The shared step counts toward the time of each job, as if the job had run alone.
  double deadline_s(const Running& job) const { return job.begin_s + context_.options.timeout_s - fit_s_; }

  void stop_late_jobs() {
    if (context_.options.timeout_s <= 0.0) return;
    for (Running& job : running_)
      if (!job.late && !job.computed && now_s() >= deadline_s(job))
        job.late = true, ::kill(job.process, SIGKILL);
  }

  /// Reads what a job sends. Returns false when its process has ended.
  bool hear(Running& job) {
    const bool open = job.reader.read_from(job.channel.descriptor());
    while (const auto line = job.reader.next()) job.outcome = outcome_from(SortedJson::parse(*line));
    return open;
  }

  void start(const std::string& command) {
    const std::size_t space = command.rfind(' ');
    const auto job = context_.manifest.read_at(command.substr(0, space));
    Running running;
    running.key = command.substr(space + 1);
    const std::size_t number = command.rfind(' ', space - 1);
    running.line = std::strtoull(command.c_str() + number, nullptr, 10);
    auto part = context_.store.begin(std::to_string(running.line) + "." + running.key);
    if (!job || !part) return report(running, outcome_of(job ? part.error() : job.error()));
    running.part = part.value();
    running.begin_s = now_s();
    if (!fork_for(running, [&] { return compute(*job, running); }))
      return fail(running, {.failure = Failure::kKilled,
                            .reason = "The system refused another process: there may be too many."});
    running_.push_back(std::move(running));
  }

  /// Starts a process that sends what `attempt` gives. Returns false where the system refuses one.
  template <class Attempt>
  bool fork_for(Running& job, Attempt attempt) {
    Channel channel = make_channel();
    job.process = channel ? ::fork() : -1;
    if (job.process == 0) {
      channel.ours.close();
      become_child(parent_of_jobs_);
      send_line(channel.theirs.descriptor(), one_line(json_of(attempt())));
      ::_exit(0);
    }
    job.channel = std::move(channel.ours);
    job.reader = {};
    return job.process > 0;
  }

  /// Runs the job and leaves all files of its result in the part, not yet on the disk.
  Outcome compute(const Job& job, const Running& running) {
    const engine::UnflushedWrites until_published;
    Outcome outcome = guarded(limit_mb(), [&] { return run(job, running.part); });
    if (outcome.failure != Failure::kNone) return outcome;
    SortedJson about = {{"key", running.key}, {"version", context_.work.version()}, {"job", job.values}};
    about.update(outcome.facts);
    const std::string text = about.dump({.indent = 1, .replaces_invalid = true}) + "\n";
    if (auto done = engine::write_file(running.part / "job.json", std::string_view(text)); !done)
      return outcome_of(done.error());
    return outcome;
  }

  Outcome run(const Job& job, const fs::path& part) {
    auto facts = prepared_->run(job, part);
    if (!facts) return outcome_of(facts.error());
    Outcome outcome;
    outcome.facts = json_of(*facts);
    return outcome;
  }

  /// Waits for the disk, and makes the result visible.
  Outcome publish(const Running& job) const {
    auto published = context_.store.publish(job.part, job.key);
    if (!published) return outcome_of(published.error());
    Outcome outcome = *job.outcome;
    outcome.there = !published.value();
    return outcome;
  }

  void finish(std::list<Running>::iterator job) {
    const Ending ending = wait_for(job->process);
    if (!job->outcome) {
      job->outcome =
          job->late ? outcome_of_timeout(context_.options.timeout_s) : outcome_of(ending, limit_mb());
      job->outcome->seconds = now_s() - job->begin_s;
    }
    if (!job->computed) {
      job->outcome->memory_mb = ending.memory_mb;
      job->outcome->cpu_s = ending.cpu_s;
      if (job->outcome->failure == Failure::kNone && start_to_publish(*job)) return;
    }
    if (job->outcome->failure == Failure::kNone)
      report(*job, *job->outcome);
    else
      fail(*job, *job->outcome);
    running_.erase(job);
  }

  /// The disk is waited for in a process of its own, beside the next job. Returns false where it was waited
  /// for in this one, since the system refuses another.
  bool start_to_publish(Running& job) {
    job.computed = true;
    if (!fork_for(job, [&] { return publish(job); })) {
      job.outcome = publish(job);
      return false;
    }
    job.outcome.reset();
    send_line(channel_.descriptor(), one_line({{"line", job.line}, {"computed", true}}));
    return true;
  }

  void fail(const Running& job, const Outcome& outcome) {
    ResultStore::discard(job.part);
    report(job, outcome);
  }

  void report(const Running& job, const Outcome& outcome) {
    send_line(channel_.descriptor(), one_line({{"line", job.line}, {"outcome", json_of(outcome)}}));
  }

  const FitterContext& context_;
  ChannelEnd channel_;
  LineReader commands_;
  std::unique_ptr<PreparedJobs> prepared_;
  std::list<Running> running_;
  double fit_s_ = 0.0;
  pid_t parent_of_jobs_ = ::getpid();
};

}  // namespace

void serve(const FitterContext& context, const Job& first, ChannelEnd channel, pid_t parent) {
  become_child(parent);
  context.manifest.forget();
  limit_memory(context.options.memory_mb);
  Fitter(context, std::move(channel)).serve(first);
  ::_exit(0);
}

}  // namespace bodice::batch
