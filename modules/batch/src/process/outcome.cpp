#include "process/outcome.hpp"

#include <csignal>
#include <utility>

#include <bodice/engine/message.hpp>

namespace bodice::inline v0_1::batch {
namespace {

using engine::SortedJson;

constexpr std::pair<Failure, const char*> kNames[] = {
    {Failure::kNone, "none"},     {Failure::kError, "error"},   {Failure::kWrite, "write"},
    {Failure::kCrash, "crash"},   {Failure::kKilled, "killed"}, {Failure::kTimeout, "timeout"},
    {Failure::kMemory, "memory"},
};

}  // namespace

std::string name(Failure failure) {
  for (const auto& [value, text] : kNames)
    if (value == failure) return text;
  return "";
}

Failure failure_from_name(const std::string& name) {
  for (const auto& [value, text] : kNames)
    if (name == text) return value;
  return Failure::kError;
}

bool may_differ_next_time(Failure failure) {
  return failure >= Failure::kCrash;
}

SortedJson json_of(const Outcome& outcome) {
  return {{"failure", name(outcome.failure)},
          {"there", outcome.there},
          {"reason", outcome.reason},
          {"seconds", outcome.seconds},
          {"cpu_s", outcome.cpu_s},
          {"memory_mb", outcome.memory_mb},
          {"facts", outcome.facts}};
}

Outcome outcome_from(const SortedJson& j) {
  Outcome outcome;
  outcome.failure = failure_from_name(j.value("failure", "error"));
  outcome.there = j.value("there", false);
  outcome.reason = j.value("reason", "");
  outcome.seconds = j.value("seconds", 0.0);
  outcome.cpu_s = j.value("cpu_s", 0.0);
  outcome.memory_mb = j.value("memory_mb", 0.0);
  outcome.facts = j.value("facts", SortedJson::object());
  return outcome;
}

SortedJson json_of(const JobFacts& facts) {
  SortedJson warnings = SortedJson::array();
  for (const engine::Warning& w : facts.warnings)
    warnings.push_back(
        {{"code", w.code}, {"part", w.part}, {"message", w.message}, {"remedy", w.remedy}, {"note", w.note}});
  SortedJson numbers = SortedJson::object();
  for (const auto& [key, value] : facts.numbers) numbers[key] = value;
  return {{"seed", facts.seed}, {"warnings", std::move(warnings)}, {"numbers", std::move(numbers)}};
}

std::string one_line(const SortedJson& value) {
  return value.dump({.replaces_invalid = true});
}

Outcome outcome_of(const engine::Error& error) {
  const bool is_write = error.code == engine::ErrorCode::kWriteFailed;
  return {.failure = is_write ? Failure::kWrite : Failure::kError, .reason = error.sentence()};
}

Outcome outcome_of(const Ending& ending, double limit_mb) {
  Outcome outcome;
  outcome.failure = Failure::kCrash;
  outcome.memory_mb = ending.memory_mb;
  const std::string used = engine::message(", with ", ending.memory_mb, " MB in use");
  if (ending.signal() == SIGKILL) {
    outcome.failure = Failure::kKilled;
    outcome.reason = "It was killed from outside" + used + ": the machine may have run out of memory.";
  } else if (limit_mb > 0.0 && ending.memory_mb > 0.9 * limit_mb) {
    outcome.failure = Failure::kMemory;
    outcome.reason = engine::message("It ended at its limit of ", limit_mb, " MB.");
  } else {
    outcome.reason = "It crashed (" +
                     (ending.signal() ? signal_name(ending.signal()) : std::string("an early exit")) + ")" +
                     used + ".";
  }
  return outcome;
}

Outcome outcome_of_timeout(double timeout_s) {
  return {.failure = Failure::kTimeout, .reason = engine::message("It took longer than ", timeout_s, " s.")};
}

Outcome outcome_of_memory(double limit_mb) {
  const std::string what = limit_mb > 0.0 ? engine::message("its limit of ", limit_mb, " MB") : "there is";
  return {.failure = Failure::kMemory, .reason = "It needed more memory than " + what + "."};
}

}  // namespace bodice::batch
