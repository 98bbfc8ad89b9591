#include "remesh.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <queue>
#include <set>

namespace remesh {
namespace {

using bodice::geometry::Index;
using bodice::geometry::Triangle;
using bodice::geometry::TriMesh;
using bodice::geometry::Vec3;

constexpr double kLeastTurn = 0.2;  // cosine between a triangle's normals before and after

Vec3 normal(const std::array<Vec3, 3>& p) {
  return (p[1] - p[0]).cross(p[2] - p[0]);
}

/// Half-edge collapses to the kept vertex, cheapest first.
class Decimator {
 public:
  explicit Decimator(const TriMesh& mesh)
      : mesh_(mesh), around_(mesh.positions.size()), alive_(mesh.positions.size(), 1) {
    for (Index f = 0; f < mesh.triangles.size(); ++f)
      for (const Index v : mesh.triangles[f]) around_[v].insert(f);
    dead_.assign(mesh.triangles.size(), 0);
    for (const auto& t : mesh.triangles)
      for (int k = 0; k < 3; ++k) push(t[k], t[(k + 1) % 3]);
  }
  TriMesh run(std::size_t wanted) {
    std::size_t count = mesh_.positions.size();
    while (count > wanted && !queue_.empty()) {
      const auto [cost, from, to] = queue_.top();
      queue_.pop();
      if (!alive_[from] || !alive_[to] || cost != cost_of(from, to) || !allowed(from, to)) continue;
      collapse(from, to);
      --count;
    }
    return compact();
  }

 private:
  /// Long edges and bent surfaces cost more.
  double cost_of(Index from, Index to) const {
    double bend = 0.0;
    Vec3 mean = Vec3::Zero();
    for (const Index f : around_[from]) mean += normal(corners(f)).normalized();
    for (const Index f : around_[from])
      bend = std::max(bend, 1.0 - normal(corners(f)).normalized().dot(mean.normalized()));
    return (mesh_.positions[from] - mesh_.positions[to]).norm() * (0.1 + bend);
  }
  void push(Index from, Index to) {
    queue_.push({cost_of(from, to), from, to});
    queue_.push({cost_of(to, from), to, from});
  }
  std::array<Vec3, 3> corners(Index f) const {
    const auto& t = mesh_.triangles[f];
    return {mesh_.positions[t[0]], mesh_.positions[t[1]], mesh_.positions[t[2]]};
  }
  std::set<Index> neighbors(Index v) const {
    std::set<Index> near;
    for (const Index f : around_[v])
      for (const Index w : mesh_.triangles[f])
        if (w != v) near.insert(w);
    return near;
  }
  /// The link condition (two common neighbors), and no triangle may turn over.
  bool allowed(Index from, Index to) const {
    const auto a = neighbors(from), b = neighbors(to);
    std::vector<Index> common;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
    if (a.count(to) == 0 || common.size() != 2) return false;
    for (const Index f : around_[from]) {
      const auto& t = mesh_.triangles[f];
      if (t[0] == to || t[1] == to || t[2] == to) continue;
      std::array<Vec3, 3> after = corners(f);
      for (int k = 0; k < 3; ++k)
        if (t[k] == from) after[k] = mesh_.positions[to];
      const Vec3 n = normal(corners(f)), m = normal(after);
      if (!(n.dot(m) > kLeastTurn * n.norm() * m.norm())) return false;
    }
    return true;
  }
  void collapse(Index from, Index to) {
    for (const Index f : around_[from]) {
      auto& t = mesh_.triangles[f];
      if (t[0] == to || t[1] == to || t[2] == to) {
        dead_[f] = 1;
        for (const Index w : t)
          if (w != from) around_[w].erase(f);
        continue;
      }
      for (Index& v : t)
        if (v == from) v = to;
      around_[to].insert(f);
    }
    alive_[from] = 0;
    around_[from].clear();
    for (const Index w : neighbors(to)) {
      push(w, to);
      for (const Index x : neighbors(w)) push(w, x);
    }
  }
  TriMesh compact() const {
    TriMesh result;
    std::vector<Index> new_index(alive_.size(), bodice::geometry::kNoIndex);
    for (std::size_t v = 0; v < alive_.size(); ++v)
      if (alive_[v]) {
        new_index[v] = static_cast<Index>(result.positions.size());
        result.positions.push_back(mesh_.positions[v]);
      }
    for (std::size_t f = 0; f < dead_.size(); ++f) {
      const auto& t = mesh_.triangles[f];
      if (!dead_[f]) result.triangles.push_back({new_index[t[0]], new_index[t[1]], new_index[t[2]]});
    }
    return result;
  }

  struct Entry {
    double cost;
    Index from, to;
    bool operator<(const Entry& other) const {
      return std::tie(cost, from, to) > std::tie(other.cost, other.from, other.to);
    }
  };
  TriMesh mesh_;
  std::vector<std::set<Index>> around_;
  std::vector<char> alive_, dead_;
  std::priority_queue<Entry> queue_;
};

}  // namespace

TriMesh refined(const TriMesh& mesh) {
  TriMesh fine{mesh.positions, {}};
  std::map<std::pair<Index, Index>, Index> middle;
  const auto half = [&](Index a, Index b) {
    const auto [it, fresh] = middle.try_emplace(std::minmax(a, b), static_cast<Index>(fine.positions.size()));
    if (fresh) fine.positions.push_back(0.5 * (mesh.positions[a] + mesh.positions[b]));
    return it->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const Index ab = half(a, b), bc = half(b, c), ca = half(c, a);
    fine.triangles.insert(fine.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return fine;
}

TriMesh decimated(const TriMesh& mesh, std::size_t vertices) {
  return Decimator(mesh).run(vertices);
}

}  // namespace remesh
