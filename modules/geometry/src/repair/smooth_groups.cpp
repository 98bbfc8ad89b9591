#include "repair/smooth_groups.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "repair/agreement.hpp"
#include "repair/quadric.hpp"
#include "repair/rings.hpp"
#include "repair/smooth_normals.hpp"

namespace bodice::inline v0_1::geometry {
namespace {

/// Groups that a quadric needs: each has several points, and their spread counts as well.
constexpr int kFewestGroups = 7;

/// The upper half of a symmetric matrix: xx, yy, zz, xy, xz, yz.
using Symmetric = Eigen::Matrix<double, 6, 1>;

/// The points that were merged into one vertex.
struct Group {
  Vec3 mean = Vec3::Zero();
  Symmetric spread = Symmetric::Zero();  ///< covariance of the points
  double count = 0.0;
};

/// The coefficients of a^T M b for a symmetric M.
Symmetric product_of(const Vec3& a, const Vec3& b) {
  return Symmetric{{a.x() * b.x(), a.y() * b.y(), a.z() * b.z(), a.x() * b.y() + a.y() * b.x(),
                    a.x() * b.z() + a.z() * b.x(), a.y() * b.z() + a.z() * b.y()}};
}

Symmetric square_of(const Vec3& p) {
  return Symmetric{
      {p.x() * p.x(), p.y() * p.y(), p.z() * p.z(), p.x() * p.y(), p.x() * p.z(), p.y() * p.z()}};
}

std::vector<Group> groups_of(const TriMesh& noisy, const ThinnedSurface& thinned) {
  std::vector<Group> groups(thinned.kept.size());
  for (std::size_t v = 0; v < noisy.positions.size(); ++v) {
    const Index to = thinned.vertex_of_input[v];
    const Vec3 offset = noisy.positions[v] - noisy.positions[thinned.kept[to]];
    groups[to].mean += offset;
    groups[to].spread += square_of(offset);
    groups[to].count += 1.0;
  }
  for (std::size_t k = 0; k < groups.size(); ++k) {
    Group& group = groups[k];
    group.mean /= group.count;
    group.spread = group.spread / group.count - square_of(group.mean);
    group.mean += noisy.positions[thinned.kept[k]];
  }
  return groups;
}

/// Least squares of a height over a plane by the means that groups have of 1, u, v, u^2, u v and v^2.
class GroupQuadric {
 public:
  GroupQuadric(const Vec3& origin, const Vec3& normal, double scale)
      : origin_(origin),
        normal_(normal / scale),
        u_(normal.unitOrthogonal() / scale),
        v_(normal.cross(u_)),
        uu_(product_of(u_, u_)),
        uv_(product_of(u_, v_)),
        vv_(product_of(v_, v_)),
        scale_(scale) {}

  void add(const Group& group) {
    const Vec3 d = group.mean - origin_;
    const double u = d.dot(u_), v = d.dot(v_), h = d.dot(normal_);
    const std::array<double, kTerms> terms = {1.0,
                                              u,
                                              v,
                                              u * u + uu_.dot(group.spread),
                                              u * v + uv_.dot(group.spread),
                                              v * v + vv_.dot(group.spread)};
    for (int i = 0; i < kTerms; ++i) {
      const double weighted = group.count * terms[static_cast<std::size_t>(i)];
      for (int j = 0; j <= i; ++j) squares_(i, j) += weighted * terms[static_cast<std::size_t>(j)];
      heights_[i] += weighted * h;
    }
    rest_ += group.count * h * h;
    ++count_;
  }
  int count() const { return count_; }

  std::optional<Quadric::Value> value() const {
    if (count_ < kFewestGroups) return std::nullopt;
    return Quadric::solve({squares_, heights_, rest_, count_}, scale_);
  }

 private:
  static constexpr int kTerms = 6;
  Vec3 origin_, normal_, u_, v_;  // the axes divided by the scale
  Symmetric uu_, uv_, vv_;
  double scale_;
  Eigen::Matrix<double, kTerms, kTerms> squares_ = Eigen::Matrix<double, kTerms, kTerms>::Zero();
  Eigen::Matrix<double, kTerms, 1> heights_ = Eigen::Matrix<double, kTerms, 1>::Zero();
  double rest_ = 0.0;
  int count_ = 0;
};

/// Finds how far vertices lie off the widest quadrics that their groups follow.
class GroupSmoother {
 public:
  GroupSmoother(const std::vector<Vec3>& positions, const std::vector<Group>& groups,
                const std::vector<Vec3>& normals, const Agreement& agreement, double scale)
      : positions_(positions), groups_(groups), normals_(normals), agreement_(agreement), scale_(scale) {}

  double height(Rings& rings, Index vertex) const {
    if (!(normals_[vertex].squaredNorm() > 0.5)) return 0.0;
    const double alone = (groups_[vertex].mean - positions_[vertex]).dot(normals_[vertex]);
    GroupQuadric quadric(positions_[vertex], normals_[vertex], scale_);
    quadric.add(groups_[vertex]);
    std::optional<double> best;
    HeightRange range;
    rings.begin(vertex);
    for (auto ring = rings.grow(); is_near(ring, vertex); ring = rings.grow()) {
      for (const Index v : ring) quadric.add(groups_[v]);
      const auto fit = quadric.value();
      if (!fit) continue;
      if (!agreement_.follows(*fit, quadric.count()) || !range.meet(fit->height, agreement_.deviation(*fit)))
        return best.value_or(fit->height);
      best = fit->height;
      if (agreement_.is_certain(*fit)) break;
    }
    return best.value_or(alone);
  }

 private:
  /// Whether there are vertices, near enough on average.
  bool is_near(std::span<const Index> ring, Index vertex) const {
    double sum = 0.0;
    for (const Index v : ring) sum += (positions_[v] - positions_[vertex]).norm();
    return !ring.empty() && sum < agreement_.farthest() * static_cast<double>(ring.size());
  }

  const std::vector<Vec3>& positions_;
  const std::vector<Group>& groups_;
  const std::vector<Vec3>& normals_;
  Agreement agreement_;
  double scale_;
};

}  // namespace

std::vector<Vec3> smooth_groups(const engine::Context& context, const TriMesh& noisy,
                                const ThinnedSurface& thinned, double noise) {
  const std::vector<Group> groups = groups_of(noisy, thinned);
  TriMesh means{{}, thinned.mesh.triangles};
  for (const Group& group : groups) means.positions.push_back(group.mean);
  std::vector<Vec3> smooth;
  for (const Index v : thinned.kept) smooth.push_back(noisy.positions[v]);
  const Neighbors neighbors(thinned.mesh);
  const std::vector<Vec3> normals = smooth_normals(context, neighbors, vertex_normals(means));
  const std::vector<Vec3> positions = smooth;
  const double scale = 2.0 * std::sqrt(surface_area(means) / static_cast<double>(groups.size()));
  const GroupSmoother smoother(positions, groups, normals, Agreement(positions, noise), scale);
  for_each_with_rings(context, neighbors,
                      [&](Index v, Rings& rings) { smooth[v] += smoother.height(rings, v) * normals[v]; });
  return smooth;
}

}  // namespace bodice::geometry
