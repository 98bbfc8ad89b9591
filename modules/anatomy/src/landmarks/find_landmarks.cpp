#include "landmarks/find_landmarks.hpp"

#include <algorithm>

#include <bodice/engine/parallel.hpp>

#include "landmarks/landmark_table.hpp"
#include "skin/soft_position.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

/// A difference this many times the contradictory one leaves no confidence, so that half is left at that one.
constexpr double kNothingLeft = 1.5;

/// One landmark of the table.
struct Task {
  const LandmarkKind* kind;
  int side;
  LandmarkId id() const { return body::of_side(kind->id, side); }
};

std::vector<Task> all_tasks() {
  std::vector<Task> tasks;
  for_each_landmark([&](const LandmarkKind& kind, int side) { tasks.push_back({&kind, side}); });
  return tasks;
}

void find_first(const LandmarkInput& input, const std::vector<Task>& tasks, Landmarks& marks) {
  engine::parallel_for(input.context, tasks.size(), 1, [&](std::size_t i, std::size_t) {
    if (tasks[i].kind->find) marks[tasks[i].id()] = tasks[i].kind->find(input, tasks[i].side);
  });
}

/// Both sides are computed from the same state, so that a mirrored body gives mirrored landmarks.
template <class Step>
void run_step(const LandmarkInput& input, Step LandmarkKind::*step, Landmarks& marks) {
  for (const LandmarkKind& kind : landmark_kinds()) {
    if (kind.*step == nullptr) continue;
    std::array<FoundLandmark, 2> next;
    const int sides = kind.paired ? 2 : 1;
    for (int side = 0; side < sides; ++side) next[side] = (kind.*step)(input, marks, side);
    for (int side = 0; side < sides; ++side) marks[body::of_side(kind.id, side)] = next[side];
  }
}

Differences check_all(const LandmarkInput& input, const std::vector<Task>& tasks, const Landmarks& marks) {
  Differences differences;
  for (auto& of_landmark : differences) of_landmark.fill(-1.0);
  engine::parallel_for(input.context, tasks.size(), 1, [&](std::size_t i, std::size_t) {
    const auto& checks = tasks[i].kind->checks;
    for (std::size_t c = 0; c < checks.size(); ++c)
      if (checks[c].difference)
        differences[static_cast<std::size_t>(tasks[i].id())][c] =
            checks[c].difference(input, marks, tasks[i].side);
  });
  return differences;
}

void lower_confidence(const std::vector<Task>& tasks, const Differences& differences, Landmarks& marks) {
  for (const Task& task : tasks)
    for (std::size_t c = 0; c < task.kind->checks.size(); ++c) {
      const CrossCheck& check = task.kind->checks[c];
      double& confidence = marks[task.id()].mark.confidence;
      if (check.difference)
        confidence = checked_confidence(confidence, differences[static_cast<std::size_t>(task.id())][c],
                                        kNothingLeft * check.most);
    }
}

}  // namespace

double checked_confidence(double confidence, double difference, double most) {
  if (!(difference >= 0.0)) return 0.5 * confidence;
  const double off = std::min(1.0, difference / most);
  return confidence * (1.0 - off * off);
}

CheckedLandmarks find_landmarks(const engine::Context& context, const Skin& skin,
                                const BodyCoordinates& coordinates, CorrectionRecords* records) {
  const LandmarkInput input{context, skin, coordinates, head_ball(skin, coordinates), records};
  const std::vector<Task> tasks = all_tasks();
  CheckedLandmarks found;
  find_first(input, tasks, found.marks);
  found.marks.head_profile = head_profile(skin, coordinates, input.head, found.marks[LandmarkId::kNeck].loop);
  run_step(input, &LandmarkKind::refine, found.marks);
  run_step(input, &LandmarkKind::finish, found.marks);
  found.differences = check_all(input, tasks, found.marks);
  lower_confidence(tasks, found.differences, found.marks);
  return found;
}

std::vector<body::Landmark> to_list(const Skin& skin, const Landmarks& marks) {
  std::vector<body::Landmark> list(marks.of.size());
  for_each_landmark([&](const LandmarkKind& kind, int side) {
    const LandmarkId id = body::of_side(kind.id, side);
    body::Landmark& mark = list[static_cast<std::size_t>(id)];
    if (marks[id].mark.vertex != geometry::kNoIndex) mark = marks[id].mark;
    mark.id = id;
    if (kind.on_skin) mark.vertex = vertex_near(skin, mark.position, mark.vertex);
  });
  return list;
}

}  // namespace bodice::anatomy
