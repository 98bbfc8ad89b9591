#include "scan/flaws.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace bodice::inline v0_1::synth {
namespace {

using geometry::Index;
using geometry::kNoIndex;
using geometry::TriMesh;
using geometry::Vec3;

template <class Keep>
TriMesh kept(const TriMesh& mesh, Keep&& keep) {
  TriMesh out;
  std::vector<Index> number(mesh.positions.size(), kNoIndex);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!keep(t)) continue;
    geometry::Triangle& triangle = out.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      Index& n = number[mesh.triangles[t][k]];
      if (n == kNoIndex) {
        n = static_cast<Index>(out.positions.size());
        out.positions.push_back(mesh.positions[mesh.triangles[t][k]]);
      }
      triangle[k] = n;
    }
  }
  return out;
}

}  // namespace

TriMesh take(const TriMesh& mesh, std::span<const int> value, int wanted) {
  return kept(mesh, [&](std::size_t t) { return value[t] == wanted; });
}

TriMesh take_others(const TriMesh& mesh, std::span<const int> value, int unwanted) {
  return kept(mesh, [&](std::size_t t) { return value[t] != unwanted; });
}

void add_noise(double sigma_m, engine::Random& random, TriMesh& mesh) {
  const std::vector<Vec3> normal = vertex_normals(mesh);
  for (std::size_t v = 0; v < normal.size(); ++v) mesh.positions[v] += sigma_m * random.normal() * normal[v];
}

void add_waves(double height_m, engine::Random& random, TriMesh& mesh) {
  constexpr int kWaves = 6;
  struct Wave {
    Vec3 direction;
    double phase;
  };
  std::array<Wave, kWaves> waves;
  for (Wave& wave : waves) {
    const Vec3 direction = Vec3(random.normal(), random.normal(), random.normal()).normalized();
    wave = {direction * 2.0 * std::numbers::pi / random.uniform(0.1, 0.3),
            random.uniform(0.0, 2.0 * std::numbers::pi)};
  }
  const std::vector<Vec3> normal = vertex_normals(mesh);
  for (std::size_t v = 0; v < normal.size(); ++v) {
    double sum = 0.0;
    for (const Wave& wave : waves) sum += std::sin(wave.direction.dot(mesh.positions[v]) + wave.phase);
    mesh.positions[v] += height_m * sum / std::sqrt(0.5 * kWaves) * normal[v];
  }
}

void jitter(double share, engine::Random& random, TriMesh& mesh) {
  std::vector<double> shortest(mesh.positions.size(), std::numeric_limits<double>::infinity());
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const double length = (mesh.positions[t[k]] - mesh.positions[t[(k + 1) % 3]]).norm();
      for (const Index v : {t[k], t[(k + 1) % 3]}) shortest[v] = std::min(shortest[v], length);
    }
  const std::vector<Vec3> normal = vertex_normals(mesh);
  for (std::size_t v = 0; v < normal.size(); ++v) {
    if (!std::isfinite(shortest[v])) continue;
    const Vec3 move = share * shortest[v] * Vec3(random.normal(), random.normal(), random.normal());
    mesh.positions[v] += move - normal[v].dot(move) * normal[v];
  }
}

void append(const TriMesh& mesh, TriMesh& to) {
  const auto first = static_cast<Index>(to.positions.size());
  to.positions.insert(to.positions.end(), mesh.positions.begin(), mesh.positions.end());
  for (const auto& t : mesh.triangles) to.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

void shift(const Vec3& by, TriMesh& mesh) {
  for (Vec3& p : mesh.positions) p += by;
}

}  // namespace bodice::synth
