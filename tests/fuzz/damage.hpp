// A mesh that bytes cut, fold, double and set among other things, as scans and games leave bodies.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

#include "harness.hpp"

namespace fuzz {

/// A copy of a body in the making. Each byte names a damage, and the next ones its position and size.
class Damage {
  using Index = bodice::geometry::Index;
  using TriMesh = bodice::geometry::TriMesh;
  using Triangle = bodice::geometry::Triangle;
  using Vec3 = bodice::geometry::Vec3;

 public:
  Damage(Bytes& in, const TriMesh& body) : in_(in), body_(body), mesh_(body) {}

  TriMesh run() {
    while (!in_.rest().empty() && !mesh_.triangles.empty()) next();
    return std::move(mesh_);
  }

 private:
  static constexpr std::size_t kMostTriangles = 8000;

  void next() {
    const unsigned kind = in_.next() % 18u;
    switch (kind) {
      case 0:
        return drop(in_.next() % 2 == 0);
      case 1:
        return flip();
      case 2:
        return double_patch();
      case 3:
        return add_noise();
      case 4:
        return part();
      case 5:
        return add_box();
      case 6:
        return add_body();
      case 7:
        return collapse();
      case 8:
        return displace_one();
      case 9:
        return add_triangles();
      case 10:
        return rescale();
      case 11:
        return unshare();
      case 12:
        return snap();
      case 13:
        return squeeze();
      case 14:
        return fold();
      case 15:
        return turn_axes();
      case 16:
        return push_ball();
      default:
        return add_debris();
    }
  }

  double share() { return in_.next() / 255.0; }
  Index vertex() {
    const unsigned high = in_.next();
    return static_cast<Index>((high << 8 | in_.next()) % std::max<std::size_t>(mesh_.positions.size(), 1));
  }
  Vec3 direction() {
    const Vec3 d(share() - 0.5, share() - 0.5, share() - 0.5);
    return d.norm() > 0.0 ? Vec3(d.normalized()) : Vec3(Vec3::UnitY());
  }
  bool room() const { return mesh_.triangles.size() < kMostTriangles; }

  /// Which vertices lie in a ball around one of them.
  std::vector<bool> ball() {
    const Vec3 center = mesh_.positions[vertex()];
    const double radius = share() * share();
    std::vector<bool> inside(mesh_.positions.size());
    for (std::size_t v = 0; v < inside.size(); ++v)
      inside[v] = (mesh_.positions[v] - center).norm() <= radius;
    return inside;
  }
  static bool has(const std::vector<bool>& inside, const Triangle& t) {
    return inside[t[0]] || inside[t[1]] || inside[t[2]];
  }

  void drop(bool what_is_inside) {
    const std::vector<bool> inside = ball();
    std::erase_if(mesh_.triangles, [&](const auto& t) { return has(inside, t) == what_is_inside; });
  }
  void flip() {
    const std::vector<bool> inside = ball();
    for (auto& t : mesh_.triangles)
      if (has(inside, t)) std::swap(t[1], t[2]);
  }
  /// Another camera's view of the same skin, displaced.
  void double_patch() {
    const std::vector<bool> inside = ball();
    const Vec3 by = 0.05 * share() * direction();
    const auto first = static_cast<Index>(mesh_.positions.size());
    const std::size_t count = mesh_.triangles.size();
    for (Index v = 0; v < first; ++v) mesh_.positions.push_back(mesh_.positions[v] + by);
    for (std::size_t t = 0; t < count && room(); ++t) {
      const auto [a, b, c] = mesh_.triangles[t];
      if (has(inside, {a, b, c})) mesh_.triangles.push_back({a + first, b + first, c + first});
    }
  }
  void add_noise() {
    const double size = 0.02 * share();
    for (Vec3& p : mesh_.positions) {  // numbers that look random, and are the same each time
      const double seed = p.dot(Vec3(127.1, 311.7, 74.7));
      p += size * Vec3(std::sin(seed), std::sin(2.3 * seed), std::sin(3.7 * seed));
    }
  }
  /// Cuts at a plane: what is beyond it is a piece of its own, and moves.
  void part() {
    const Vec3 at = mesh_.positions[vertex()], normal = direction();
    const Vec3 by = (share() - 0.5) * 0.2 * normal;
    std::vector<Index> copy(mesh_.positions.size(), bodice::geometry::kNoIndex);
    for (auto& t : mesh_.triangles) {
      if ((mesh_.positions[t[0]] - at).dot(normal) <= 0.0) continue;
      for (Index& v : t) {
        if (copy[v] == bodice::geometry::kNoIndex) {
          copy[v] = static_cast<Index>(mesh_.positions.size());
          mesh_.positions.push_back(mesh_.positions[v] + by);
        }
        v = copy[v];
      }
    }
  }
  void add_box() {
    const Vec3 low = mesh_.positions[vertex()],
               high = low + Vec3(2.0 * share(), share() - 0.5, 2.0 * share());
    const unsigned missing = in_.next();
    const auto first = static_cast<Index>(mesh_.positions.size());
    for (unsigned k = 0; k < 8; ++k)
      mesh_.positions.push_back(
          {k & 1u ? high.x() : low.x(), k & 2u ? high.y() : low.y(), k & 4u ? high.z() : low.z()});
    constexpr Index kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                    {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (unsigned f = 0; f < 6; ++f) {
      if ((missing & 0xC0u) == 0xC0u && (missing >> f & 1u)) continue;
      const auto& c = kFaces[f];
      mesh_.triangles.push_back({first + c[0], first + c[1], first + c[2]});
      mesh_.triangles.push_back({first + c[0], first + c[2], first + c[3]});
    }
  }
  void add_body() {
    if (!room()) return;
    const double angle = 2.0 * std::numbers::pi * share(), size = 0.2 + 1.2 * share();
    const Vec3 by(2.0 * share() - 1.0, 0.2 * share() - 0.1, 2.0 * share() - 1.0);
    const auto first = static_cast<Index>(mesh_.positions.size());
    for (const Vec3& p : body_.positions)
      mesh_.positions.push_back(size * Vec3(std::cos(angle) * p.x() + std::sin(angle) * p.z(), p.y(),
                                            std::cos(angle) * p.z() - std::sin(angle) * p.x()) +
                                by);
    for (const auto& t : body_.triangles)
      mesh_.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  /// All vertices of a ball become one.
  void collapse() {
    const std::vector<bool> inside = ball();
    const auto kept = static_cast<Index>(std::find(inside.begin(), inside.end(), true) - inside.begin());
    for (auto& t : mesh_.triangles)
      for (Index& v : t)
        if (inside[v]) v = kept;
  }
  void displace_one() {
    Vec3& p = mesh_.positions[vertex()];
    constexpr double kFar[] = {0.01,
                               0.1,
                               1.0,
                               1e3,
                               1e9,
                               1e30,
                               std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::quiet_NaN()};
    p += kFar[in_.next() % std::size(kFar)] * direction();
  }
  void add_triangles() {
    for (unsigned n = in_.next() % 32u; n > 0; --n) mesh_.triangles.push_back({vertex(), vertex(), vertex()});
  }
  void rescale() {
    constexpr double kUnits[] = {1e3, 100.0, 10.0, 1.0 / 0.0254, 0.3048, 0.001, 7.0, 1e-9};
    const double factor = kUnits[in_.next() % std::size(kUnits)];
    for (Vec3& p : mesh_.positions) p *= factor;
  }
  /// Each triangle gets vertices of its own.
  void unshare() {
    TriMesh soup;
    for (const auto& t : mesh_.triangles) {
      const auto first = static_cast<Index>(soup.positions.size());
      for (const Index v : t) soup.positions.push_back(mesh_.positions[v]);
      soup.triangles.push_back({first, first + 1, first + 2});
    }
    mesh_ = std::move(soup);
  }
  /// Positions come to lie on a lattice, so that many coincide.
  void snap() {
    const double cell = 0.002 + 0.1 * share();
    for (Vec3& p : mesh_.positions) p = cell * Vec3((p / cell).array().round());
  }
  /// Flattens everything along an axis, to nothing if the byte is zero.
  void squeeze() {
    const unsigned axis = in_.next() % 3u;
    const double by = share();
    for (Vec3& p : mesh_.positions) p[axis] *= by;
  }
  /// Mirrors at a plane what lies beyond it.
  void fold() {
    const Vec3 at = mesh_.positions[vertex()], normal = direction();
    for (Vec3& p : mesh_.positions) p -= 2.0 * std::max(0.0, (p - at).dot(normal)) * normal;
  }
  void turn_axes() {
    const unsigned kind = in_.next();
    for (Vec3& p : mesh_.positions) {
      p = Vec3(p.y(), p.z(), p.x());
      if (kind & 1u) p.x() = -p.x();  // a mirror image
    }
  }
  /// Skin is pushed into skin, or out of it.
  void push_ball() {
    const std::vector<bool> inside = ball();
    const Vec3 by = 0.4 * share() * direction();
    for (std::size_t v = 0; v < inside.size(); ++v)
      if (inside[v]) mesh_.positions[v] += by;
  }
  void add_debris() {
    const Vec3 around = mesh_.positions[vertex()] + share() * direction();
    for (unsigned n = in_.next() % 8u; n > 0; --n) {
      const auto first = static_cast<Index>(mesh_.positions.size());
      for (int k = 0; k < 3; ++k) mesh_.positions.push_back(around + 0.1 * share() * direction());
      mesh_.triangles.push_back({first, first + 1, first + 2});
    }
  }

  Bytes& in_;
  const TriMesh& body_;
  TriMesh mesh_;
};

}  // namespace fuzz
