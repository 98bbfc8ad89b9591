#include "selfcontact/tangles.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>

#include "base/tolerances.hpp"
#include "pairs/near_faces.hpp"
#include "selfcontact/passage.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

// The least sine of the angle between an edge and a triangle's plane that the gradient uses. With a smaller
// one it would be too long.
constexpr float kLeastSine = 0.2f;

bool cross_each_other(const Face& a, const Face& b, std::span<const Point> at) {
  bool found = false;
  for_each_passage(a, b, at, [&](unsigned, const Passage&) { found = true; });
  for_each_passage(b, a, at, [&](unsigned, const Passage&) { found = true; });
  return found;
}

// Moves edge k of `of`, and the triangle `face` that it passes through against it, so that the line along
// which the two triangles cross becomes shorter.
void shorten_crossing(const Face& of, unsigned k, const Face& face, const Passage& passage,
                      const Untangling& how, std::span<Point> at) {
  const Index p = of.particle[k], q = of.particle[(k + 1) % 3];
  const Float4 from = at_particle(at, p), a = at_particle(at, face.particle[0]);
  const Float4 edge = unit(at_particle(at, q) - from),
               inward = at_particle(at, of.particle[(k + 2) % 3]) - from;
  const Float4 normal =
      unit(cross(at_particle(at, face.particle[1]) - a, at_particle(at, face.particle[2]) - a));
  Float4 line = unit(cross(normal, cross(edge, inward)));
  if (dot(line, inward - dot(inward, edge) * edge) < 0.0f) line = -line;
  const float sine = dot(edge, normal);
  const float bounded = std::copysign(std::max(std::abs(sine), kLeastSine), sine);
  const Float4 gradient = line - (dot(edge, line) / bounded) * normal;
  const Index particle[5] = {p, q, face.particle[0], face.particle[1], face.particle[2]};
  const float weight[5] = {passage.edge[0], passage.edge[1], -passage.face[0], -passage.face[1],
                           -passage.face[2]};
  auto free_weight = [&](Index i) { return how.inverse_mass[i] > 0.0f ? at[i].weight : 0.0f; };
  float all = kTinyWeight, most = 0.0f;
  for (int i = 0; i < 5; ++i) {
    const float yielding = std::abs(weight[i]) * free_weight(particle[i]);
    all += std::abs(weight[i]) * yielding, most = std::max(most, yielding);
  }
  all = std::max(all, most);
  for (int i = 0; i < 5; ++i) {
    Point& point = at[particle[i]];
    const float share = weight[i] * free_weight(particle[i]) / all;
    store(point, load(point) + (how.step_m * share) * xyz(gradient));
  }
}

// Limits the displacement of a point to `most_m`.
void limit_displacement(float most_m, const Point& from, Point& to) {
  const Float4 by = xyz(load(to) - load(from));
  const float far_m = std::sqrt(dot(by, by));
  if (far_m > most_m) store(to, load(to) - (1.0f - most_m / far_m) * by);
}

bool lies_on_body(const Face& f, std::span<const std::uint8_t> touching) {
  return std::ranges::any_of(f.particle, [&](Index i) { return touching[i] != 0; });
}

bool is_beyond(const Face& f, const CrossingParts& parts) {
  return std::ranges::any_of(f.particle, [&](Index i) { return is_beyond(parts, i); });
}

// Two triangles that both lie on the body stay where they are, unless it is known which one is beyond the
// other. Otherwise they would be moved to and fro.
bool stays(const Face& a, const Face& b, const Untangling& how) {
  return lies_on_body(a, how.touching) && lies_on_body(b, how.touching) && !is_beyond(a, how.loose.parts) &&
         !is_beyond(b, how.loose.parts);
}

void search_tangles(const ContactMesh& mesh, const SweepTree& tree, std::span<const Point> at,
                    PairTask& task) {
  task.tangles.clear();
  for (std::size_t first = task.first_leaf; first < task.last_leaf; first += kLeavesTogether) {
    const std::size_t last = std::min(first + kLeavesTogether, task.last_leaf);
    for_each_near_leaf(tree, first, last, 0.0f, task.near, [&](std::size_t leaf, std::size_t other, float) {
      FaceBoxes(mesh, at, leaf, other).for_each_near(0.0f, [&](std::uint32_t a, std::uint32_t b) {
        if (cross_each_other(mesh.faces[a], mesh.faces[b], at))
          task.tangles.push_back({std::min(a, b), std::max(a, b)});
      });
    });
  }
}

}  // namespace

void find_tangles(const engine::Context& context, const ContactMesh& mesh, const SweepTree& tree,
                  std::span<const Point> at, std::vector<PairTask>& tasks, std::vector<Tangle>& tangles) {
  engine::parallel_for(context, tasks.size(), 1,
                       [&](std::size_t task, std::size_t) { search_tangles(mesh, tree, at, tasks[task]); });
  tangles.clear();
  for (const PairTask& task : tasks) tangles.insert(tangles.end(), task.tangles.begin(), task.tangles.end());
  std::ranges::sort(tangles);
}

bool add_pressed(const ContactMesh& mesh, const std::vector<PairTask>& tasks, std::span<const Point> at,
                 std::vector<Tangle>& tangles) {
  const std::size_t before = tangles.size();
  for (const PairTask& task : tasks)
    for (const Pair& pair : task.pressed) {
      for (const std::uint32_t a : mesh.star_of(pair.particle[0]))
        for (const std::uint32_t b : mesh.star_of(pair.particle[pair.edges ? 2 : 1]))
          if (a != b && cross_each_other(mesh.faces[a], mesh.faces[b], at))
            tangles.push_back({std::min(a, b), std::max(a, b)});
    }
  if (tangles.size() == before) return false;
  std::ranges::sort(tangles);
  const auto repeated = std::ranges::unique(tangles);
  tangles.erase(repeated.begin(), repeated.end());
  return true;
}

void untangle(const ContactMesh& mesh, const std::vector<Tangle>& tangles, const Untangling& how,
              std::span<Point> room, std::span<Point> at) {
  if (tangles.empty()) return;
  for (const Index i : how.loose.list) room[i] = at[i];
  for (const Tangle& t : tangles) {
    const Face &a = mesh.faces[t.a], &b = mesh.faces[t.b];
    if (stays(a, b, how)) continue;
    for_each_passage(a, b, at, [&](unsigned k, const Passage& p) { shorten_crossing(a, k, b, p, how, at); });
    for_each_passage(b, a, at, [&](unsigned k, const Passage& p) { shorten_crossing(b, k, a, p, how, at); });
  }
  for (const Index i : how.loose.list) limit_displacement(how.step_m, room[i], at[i]);
}

}  // namespace bodice::cloth
