#include "run/coordinator.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>

#include <poll.h>
#include <unistd.h>

namespace bodice::inline v0_1::batch {
namespace {

using engine::SortedJson;

constexpr int kLook_ms = 200;        // between looks at cancellation and deadlines
constexpr double kPatience_s = 5.0;  // for a fitter to clean up and end
constexpr std::size_t kNamedFailures = 10;
/// How often a fitter may die between its jobs, beyond what --retry allows.
constexpr int kDeathsForgiven = 2;

}  // namespace

Coordinator::Coordinator(const FitterContext& context, Log& log, const BatchWatcher& watcher, int most_jobs)
    : context_(context), log_(log), watcher_(watcher), most_jobs_(most_jobs), begin_s_(now_s()) {
  result_.end.lines = context_.manifest.lines();
  result_.end.total = context_.manifest.size();
  result_.log = log_.file();
}

Coordinator::~Coordinator() {
  for (Crew& crew : crews_) {
    if (crew.process <= 0) continue;
    if (!crew.is_ready()) ::kill(crew.process, SIGKILL);
    send_line(crew.channel.descriptor(), "end");
  }
  for (Crew& crew : crews_)
    if (crew.process > 0) dismiss(crew);
  context_.store.remove_leftovers();
}

engine::Result<BatchResult> Coordinator::run() {
  for (;;) {
    fill();
    show();
    result_.canceled = context_.options.cancel.canceled();
    if (fatal_) return *fatal_;
    if (result_.canceled || crews_.empty()) return result_;
    wait();
  }
}

int Coordinator::busy() const {
  int computing = 0, waiting = 0;
  for (const Crew& crew : crews_) {
    computing += crew.prepared ? 0 : 1;
    for (const auto& [line, task] : crew.running) ++(task.computed ? waiting : computing);
  }
  return computing + std::max(0, waiting - most_jobs_);
}

void Coordinator::fill() {
  for (auto crew = crews_.begin(); crew != crews_.end();) {
    while (busy() < most_jobs_ && crew->is_ready() && give_next(*crew)) {
    }
    const bool idle = crew->is_ready() && crew->running.empty() && crew->waiting.empty();
    if (idle && crew->next == crew->end) {
      send_line(crew->channel.descriptor(), "end");
      dismiss(*crew);
      crew = crews_.erase(crew);
    } else {
      ++crew;
    }
  }
  while (busy() < most_jobs_ && open_crew()) {
  }
}

std::optional<Task> Coordinator::next_task(Crew& crew) {
  if (!crew.waiting.empty()) {
    Task task = std::move(crew.waiting.front());
    crew.waiting.pop_front();
    return task;
  }
  while (crew.next < crew.end && !fatal_ && !context_.options.cancel.canceled())
    if (auto task = examine(crew.next++)) return task;
  return std::nullopt;
}

bool Coordinator::give_next(Crew& crew) {
  auto task = next_task(crew);
  if (!task) return false;
  ++task->attempts, task->computed = false;
  const std::string command = context_.manifest.address(task->index) + " " + task->key;
  send_line(crew.channel.descriptor(), command);  // if it is gone, bury() finds the job among the running
  crew.running[task->job.line] = std::move(*task);
  return true;
}

bool Coordinator::open_crew() {
  const Manifest& manifest = context_.manifest;
  while (cursor_ < manifest.size() && !fatal_ && !context_.options.cancel.canceled()) {
    Crew crew;
    crew.next = cursor_++;
    while (cursor_ < manifest.size() && manifest.continues(cursor_)) ++cursor_;
    crew.end = cursor_;
    auto first = next_task(crew);
    if (!first) continue;
    crew.waiting.push_front(std::move(*first));
    crews_.push_back(std::move(crew));
    start(crews_.back());
    return true;
  }
  return false;
}

void Coordinator::start(Crew& crew) {
  Channel channel = make_channel();
  crew.prepared.reset();
  crew.reader = {};
  crew.late = false;
  crew.begin_s = now_s();
  ++crew.starts;
  const pid_t parent = ::getpid();
  crew.process = channel ? ::fork() : -1;
  if (crew.process == 0) {
    channel.ours.close();
    serve(context_, crew.waiting.front().job, std::move(channel.theirs), parent);
  }
  if (crew.process < 0) {
    fatal_ = engine::Error{engine::ErrorCode::kInternal, "The system refused another process.",
                           "Lower --jobs, or raise the limits of processes and files (ulimit -u, -n)."};
    return;
  }
  crew.channel = std::move(channel.ours);
}

std::optional<Task> Coordinator::examine(std::size_t index) {
  auto job = context_.manifest.read(index);
  if (!job) {
    write_failure(index, nullptr, outcome_of(job.error()));
    return std::nullopt;
  }
  Task task;
  task.index = index;
  task.job = std::move(job).value();
  auto key = result_key(task.job, context_.work, files_);
  if (key && context_.store.has(key.value())) {
    ++result_.end.there;
    write({{"line", task.job.line},
           {"outcome", "there"},
           {"folder", ResultStore::folder_of(key.value())},
           {"job", task.job.values}});
    return std::nullopt;
  }
  auto fit_to_run = context_.work.check(task.job);
  if (!fit_to_run || !key) {
    write_failure(index, &task, outcome_of(fit_to_run ? key.error() : fit_to_run.error()));
    return std::nullopt;
  }
  task.key = std::move(key).value();
  return task;
}

void Coordinator::wait() {
  std::vector<pollfd> watched;
  for (const Crew& crew : crews_) watched.push_back({crew.channel.descriptor(), POLLIN, 0});
  const int count = ::poll(watched.data(), watched.size(), kLook_ms);
  auto seen = watched.begin();
  for (auto crew = crews_.begin(); count > 0 && crew != crews_.end(); ++seen) {
    const auto current = crew++;
    if (seen->revents == 0) continue;
    const bool open = current->reader.read_from(current->channel.descriptor());
    while (const auto line = current->reader.next()) hear(*current, SortedJson::parse(*line));
    if (!open && bury(*current)) crews_.erase(current);
  }
  stop_late_fits();
}

void Coordinator::stop_late_fits() {
  if (context_.options.timeout_s <= 0.0) return;
  for (Crew& crew : crews_)
    if (!crew.prepared && !crew.late && now_s() >= crew.begin_s + context_.options.timeout_s)
      crew.late = true, ::kill(crew.process, SIGKILL);
}

void Coordinator::hear(Crew& crew, const SortedJson& message) {
  if (!crew.prepared) {
    crew.prepared = outcome_from(message);
    return;
  }
  const auto found = crew.running.find(message.value("line", std::size_t{0}));
  if (found == crew.running.end()) return;
  found->second.computed = message.contains("computed");
  if (found->second.computed) return;
  Task task = std::move(found->second);
  crew.running.erase(found);
  finish(std::move(task), outcome_from(message.at("outcome")), crew);
}

void Coordinator::finish(Task task, const Outcome& outcome, Crew& crew) {
  if (outcome.failure == Failure::kNone) {
    ++(outcome.there ? result_.end.there : result_.end.done);
    SortedJson line = {{"line", task.job.line},
                       {"outcome", outcome.there ? "there" : "done"},
                       {"folder", ResultStore::folder_of(task.key)},
                       {"seconds", outcome.seconds},
                       {"cpu_seconds", outcome.cpu_s},
                       {"shared_seconds", crew.prepared->seconds},
                       {"shared_cpu_seconds", crew.prepared->cpu_s},
                       {"memory_mb", outcome.memory_mb},
                       {"attempts", task.attempts},
                       {"job", task.job.values}};
    line.update(outcome.facts);
    return write(std::move(line));
  }
  if (may_differ_next_time(outcome.failure) && task.attempts <= context_.options.retry) {
    crew.waiting.push_back(std::move(task));
    return;
  }
  write_failure(task.index, &task, outcome);
  if (outcome.failure != Failure::kWrite || fatal_) return;
  if (auto space = context_.store.check_space(); !space)
    fatal_ = engine::Error{engine::ErrorCode::kWriteFailed, space.error().message,
                           "The batch ends here. Free space and start it again: it goes on where it ended."};
}

bool Coordinator::bury(Crew& crew) {
  const Ending ending = wait_for(crew.process);
  crew.process = -1;
  crew.channel.close();
  context_.store.remove_leftovers();
  const bool served = crew.is_ready();
  Outcome outcome = crew.late                           ? outcome_of_timeout(context_.options.timeout_s)
                    : crew.prepared && !crew.is_ready() ? *crew.prepared
                                                        : outcome_of(ending, context_.options.memory_mb);
  outcome.seconds = now_s() - crew.begin_s;
  outcome.memory_mb = ending.memory_mb;
  for (auto& [line, task] : std::exchange(crew.running, {})) finish(std::move(task), outcome, crew);
  const bool again = crew.starts <= context_.options.retry + (served ? kDeathsForgiven : 0);
  if (crew.waiting.empty())
    if (auto task = next_task(crew)) crew.waiting.push_back(std::move(*task));
  if (crew.waiting.empty()) return true;
  if (again && may_differ_next_time(outcome.failure)) {
    start(crew);
    return false;
  }
  fail_all(crew, outcome);
  return true;
}

void Coordinator::fail_all(Crew& crew, const Outcome& outcome) {
  while (auto task = next_task(crew)) {
    ++task->attempts;
    write_failure(task->index, &*task, outcome);
  }
}

void Coordinator::dismiss(Crew& crew) {
  pollfd watched{crew.channel.descriptor(), POLLIN, 0};
  const double until_s = now_s() + kPatience_s;
  for (bool open = true; open;) {
    const int left_ms = static_cast<int>(std::ceil(1e3 * (until_s - now_s())));
    if (left_ms <= 0 || ::poll(&watched, 1, left_ms) <= 0) break;
    open = crew.reader.read_from(watched.fd);
  }
  if (now_s() >= until_s) ::kill(crew.process, SIGKILL);
  wait_for(crew.process);
  crew.process = -1;
}

void Coordinator::write(SortedJson line) {
  if (fatal_) return;
  if (auto done = log_.add(line); !done) fatal_ = done.error();
}

void Coordinator::write_failure(std::size_t index, const Task* task, const Outcome& outcome) {
  ++result_.end.failed;
  const std::size_t number = context_.manifest.line_number(index);
  if (result_.first_failures.size() < kNamedFailures)
    result_.first_failures.push_back("line " + std::to_string(number) + ": " + outcome.reason);
  SortedJson line = {{"line", number},
                     {"outcome", "failed"},
                     {"failure", name(outcome.failure)},
                     {"reason", outcome.reason},
                     {"seconds", outcome.seconds},
                     {"memory_mb", outcome.memory_mb},
                     {"attempts", task ? task->attempts : 0}};
  if (task) line["job"] = task->job.values;
  write(std::move(line));
}

void Coordinator::show() {
  BatchProgress& now = result_.end;
  now.seconds = now_s() - begin_s_;
  const auto run = static_cast<double>(now.done + now.failed);
  now.left_s = run > 0.0 ? now.seconds * static_cast<double>(now.total - now.finished()) / run : -1.0;
  if (watcher_) watcher_(now);
}

}  // namespace bodice::batch
