// Based on: Gavin Barill, Neil G. Dickson, Ryan Schmidt, David I. W. Levin, Alec Jacobson. Fast Winding
// Numbers for Soups and Clouds. 2018. - eq. (10), the first-order (dipole) term
// Based on: Alec Jacobson, Ladislav Kavan, Olga Sorkine-Hornung. Robust Inside-Outside Segmentation using
// Generalized Winding Numbers. 2013. - eq. (5)
#include "distance/winding.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>

#include "shape/solid_angle.hpp"

namespace bodice::inline v0_1::geometry {
namespace {

/// Moments of a set of triangles, from which the far field follows.
struct Moments {
  Vec3 area_vector = Vec3::Zero();
  Vec3 weighted_centroid = Vec3::Zero();
  double area = 0.0;
  Box box;

  void add(const Moments& other) {
    area_vector += other.area_vector;
    weighted_centroid += other.weighted_centroid;
    area += other.area;
    if (other.box.empty()) return;
    box.extend(other.box.low);
    box.extend(other.box.high);
  }
  Vec3 centroid() const {
    if (area > 0.0) return weighted_centroid / area;
    return box.empty() ? Vec3(Vec3::Zero()) : box.center();
  }
  /// Squared distance to the farthest corner of the box, an upper bound for every triangle.
  double radius2() const {
    if (box.empty()) return 0.0;
    const Vec3 c = centroid();
    return (box.high - c).cwiseMax(c - box.low).squaredNorm();
  }
};

Moments leaf_moments(const Bvh& bvh, std::uint32_t child) {
  Moments m;
  const LeafTriangles& leaf = bvh.leaf(child);
  for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
    const BvhTriangle& t = bvh.triangles[i];
    const Vec3 area_vector = 0.5 * t.ab.cross(t.ac);
    const double area = area_vector.norm();
    m.area_vector += area_vector;
    m.weighted_centroid += area * (t.a + (t.ab + t.ac) / 3.0);
    m.area += area;
    for (const Vec3& corner : {t.a, Vec3(t.a + t.ab), Vec3(t.a + t.ac)}) m.box.extend(corner);
  }
  return m;
}

void set_child(DipoleNode& node, int slot, const Moments& m) {
  const Vec3 center = m.centroid();
  for (int k = 0; k < 3; ++k) {
    node.center[k][slot] = static_cast<float>(center[k]);
    node.area[k][slot] = static_cast<float>(m.area_vector[k]);
  }
  node.radius2[slot] = static_cast<float>(m.radius2());
}

void add_leaf(const Bvh& bvh, const LeafTriangles& leaf, const Vec3& query, SolidAngleSum& sum) {
  for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
    const BvhTriangle& t = bvh.triangles[i];
    sum.add(half_solid_angle(t.a, t.a + t.ab, t.a + t.ac, query));
  }
}

/// Solid angles of the children's dipoles, and the children that are too near for them.
struct FarFields {
  Float4 angle;
  unsigned near;
};

FarFields far_fields(const DipoleNode& node, const std::array<float, 3>& q, float far_ratio2) {
  const Float4 x = node.center[0] - q[0], y = node.center[1] - q[1], z = node.center[2] - q[2];
  const Float4 distance2 = x * x + y * y + z * z;
  const Float4 flux = x * node.area[0] + y * node.area[1] + z * node.area[2];
  const Float4 excess = distance2 - far_ratio2 * node.radius2;
  return {flux / (distance2 * square_root(distance2)), 15u & ~lane_bits(excess > 0.0f)};
}

}  // namespace

std::vector<DipoleNode> build_dipoles(const Bvh& bvh) {
  std::vector<DipoleNode> dipoles(bvh.nodes.size());
  std::vector<Moments> of_node(bvh.nodes.size());
  for (std::size_t n = bvh.nodes.size(); n-- > 0;) {  // children before parents
    for (int i = 0; i < BvhNode::kWidth; ++i) {
      const std::uint32_t child = bvh.nodes[n].child[i];
      Moments m;
      if (child != BvhChild::kNone) m = BvhChild::is_leaf(child) ? leaf_moments(bvh, child) : of_node[child];
      set_child(dipoles[n], i, m);
      of_node[n].add(m);
    }
  }
  return dipoles;
}

namespace {

/// Visits what makes up a winding number: far fields of children that are far enough, and leaves that are
/// not.
template <class FarField, class Leaf>
void for_each_term(const Bvh& bvh, const std::vector<DipoleNode>& dipoles, const std::array<float, 3>& q,
                   double far_ratio, const FarField& far_field, const Leaf& leaf) {
  const auto far_ratio2 = static_cast<float>(std::min(far_ratio * far_ratio, 3e38));
  std::array<std::uint32_t, Bvh::kStackSize> stack;
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t n = stack[--depth];
    const auto [angle, too_near] = far_fields(dipoles[n], q, far_ratio2);
    for (unsigned i = 0; i < BvhNode::kWidth; ++i) {
      const std::uint32_t child = bvh.nodes[n].child[i];
      if (child == BvhChild::kNone) continue;
      if ((too_near >> i & 1u) == 0)
        far_field(angle[i]);
      else if (BvhChild::is_leaf(child))
        leaf(bvh.leaf(child));
      else
        stack[depth++] = child;
    }
  }
}

/// Clamped so that squares stay finite. At such distances the winding number is 0 anyway.
std::array<float, 3> clamped(const Vec3& query) {
  std::array<float, 3> q;
  for (int k = 0; k < 3; ++k) q[k] = static_cast<float>(std::clamp(query[k], -1e12, 1e12));
  return q;
}

}  // namespace

double winding_number(const Bvh& bvh, const std::vector<DipoleNode>& dipoles, const Vec3& query,
                      double far_ratio) {
  if (bvh.nodes.empty() || !query.allFinite()) return 0.0;
  SolidAngleSum near;
  double far = 0.0;
  for_each_term(
      bvh, dipoles, clamped(query), far_ratio, [&](float angle) { far += static_cast<double>(angle); },
      [&](const LeafTriangles& leaf) { add_leaf(bvh, leaf, query, near); });
  return (near.total() + far) / (4.0 * std::numbers::pi);
}

std::optional<double> float_winding_number(const Bvh& bvh, const std::vector<DipoleNode>& dipoles,
                                           const Vec3& query, double far_ratio) {
  if (bvh.nodes.empty() || !query.allFinite()) return 0.0;
  const std::array<float, 3> q = clamped(query);
  Float4 near{};
  Int4 unknown_side{};
  float far = 0.0f;
  for_each_term(
      bvh, dipoles, q, far_ratio, [&](float angle) { far += angle; },
      [&](const LeafTriangles& leaf) { near += leaf.half_solid_angles(q, unknown_side); });
  if (any(unknown_side)) return std::nullopt;
  const float angle = 2.0f * ((near[0] + near[1]) + (near[2] + near[3])) + far;
  return static_cast<double>(angle) / (4.0 * std::numbers::pi);
}

}  // namespace bodice::geometry
