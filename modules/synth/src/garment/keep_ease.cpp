#include "garment/keep_ease.hpp"

#include <algorithm>
#include <array>

#include <bodice/engine/parallel.hpp>

namespace bodice::inline v0_1::synth {
namespace {

using geometry::Index;

constexpr int kPushes = 24;          // each adds the missing distance; slanted skin needs several
constexpr int kAlongCut = 16;        // pushes along the cut; later ones go straight off the skin
constexpr double kLeastPush = 2e-4;  // in statures; it ends a slow approach along slanted skin
constexpr double kGenerous = 1.3;    // factor on the missing distance, since exactly that ends a little short
constexpr int kPasses = 8;           // passes of pushing, spreading and testing triangles
constexpr int kSpreads = 12;         // steps by which a push spreads over the cloth, an edge a step

/// The work of keep_ease(), a step a function.
class Presser {
 public:
  Presser(const engine::Context& context, const Fitting& fitting, Cut& cut)
      : context_(context),
        fitting_(fitting),
        cut_(cut),
        extra_(cut.mesh.positions.size(), 0.0),
        held_(cut.mesh.positions.size(), 0) {}

  bool push();
  void spread(const std::vector<Vec3>& before);
  bool triangles_outside();

 private:
  bool push_vertex(std::size_t v);
  bool each(std::size_t count, const auto& task) const;

  const engine::Context& context_;
  const Fitting& fitting_;
  Cut& cut_;
  std::vector<double> extra_;  ///< #V: distance above the ease
  std::vector<char> held_;     ///< #V: whether it was pushed since the last spread
};

/// Runs all tasks, and returns whether task(i) holds for every i.
bool Presser::each(std::size_t count, const auto& task) const {
  std::vector<char> holds(count, 0);
  engine::parallel_for(context_, count, 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) holds[i] = task(i);
  });
  return std::all_of(holds.begin(), holds.end(), [](char c) { return c != 0; });
}

bool Presser::push_vertex(std::size_t v) {
  const double wanted = fitting_.options.ease_m + extra_[v], least = kLeastPush * fitting_.body.stature_m;
  Vec3& p = cut_.mesh.positions[v];
  for (int k = 0; k <= kPushes; ++k) {
    const Vec3 world = fitting_.frame.to_world(p);
    const auto nearest = fitting_.distance.closest_point(world);
    const double missing = wanted - nearest.signed_distance;
    if (missing <= 0.0) return true;
    held_[v] = 1;
    Vec3 out = cut_.outward[v];
    const Vec3 away = (nearest.signed_distance < 0.0 ? -1.0 : 1.0) * (world - nearest.point);
    if (k >= kAlongCut && away.norm() > 0.0) out = fitting_.frame.axes.transpose() * away.normalized();
    p += (kGenerous * missing + least) * out;
  }
  return fitting_.signed_distance(p) >= fitting_.options.ease_m;
}

bool Presser::push() {
  return each(extra_.size(), [&](std::size_t v) { return push_vertex(v); });
}

/// Spreads the pushes. A push moves one row of the grid onto the next; its surroundings move by the mean of
/// their neighbors' moves, so that cells keep their shape.
void Presser::spread(const std::vector<Vec3>& before) {
  std::vector<Vec3>& p = cut_.mesh.positions;
  std::vector<Vec3> move(p.size()), sum(p.size());
  std::vector<int> count(p.size());
  for (std::size_t v = 0; v < p.size(); ++v) move[v] = p[v] - before[v];
  for (int step = 0; step < kSpreads; ++step) {
    std::fill(sum.begin(), sum.end(), Vec3::Zero());
    std::fill(count.begin(), count.end(), 0);
    for (const geometry::Triangle& t : cut_.mesh.triangles)
      for (int k = 0; k < 3; ++k)
        for (const Index w : {t[(k + 1) % 3], t[(k + 2) % 3]}) {
          sum[t[k]] += move[w];
          ++count[t[k]];
        }
    for (std::size_t v = 0; v < p.size(); ++v)
      if (!held_[v] && count[v] > 0) move[v] = sum[v] / count[v];
  }
  for (std::size_t v = 0; v < p.size(); ++v) p[v] = before[v] + move[v];
  std::fill(held_.begin(), held_.end(), 0);
}

/// Returns whether all triangles are outside. The corners of one that cuts the skin have to keep more than
/// the ease.
bool Presser::triangles_outside() {
  const auto& t = cut_.mesh.triangles;
  std::vector<double> depth(t.size(), 0.0);
  const bool outside = each(t.size(), [&](std::size_t i) {
    const Vec3 middle = (cut_.mesh.corner(i, 0) + cut_.mesh.corner(i, 1) + cut_.mesh.corner(i, 2)) / 3.0;
    depth[i] = -fitting_.signed_distance(middle);
    return depth[i] < 0.0;
  });
  const double least = kLeastPush * fitting_.body.stature_m;
  for (std::size_t i = 0; i < t.size(); ++i)
    if (depth[i] >= 0.0)
      for (const Index v : t[i]) extra_[v] += depth[i] / 3.0 + least;
  return outside;
}

}  // namespace

bool keep_ease(const engine::Context& context, const Fitting& fitting, Cut& cut) {
  Presser presser(context, fitting, cut);
  for (int pass = 0; pass < kPasses; ++pass) {
    const std::vector<Vec3> before = cut.mesh.positions;
    presser.push();
    presser.spread(before);
    if (presser.push() && presser.triangles_outside()) return true;
  }
  return false;
}

}  // namespace bodice::synth
