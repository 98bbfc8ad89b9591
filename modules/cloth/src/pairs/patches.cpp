#include "pairs/patches.hpp"

#include <algorithm>
#include <tuple>

namespace bodice::inline v0_1::cloth {
namespace {

struct Side {
  Index a, b;  // a < b
  std::uint32_t triangle;
  std::uint8_t edge;
  bool forward;

  auto ends() const { return std::tuple(a, b); }
};

std::vector<Side> sorted_sides(const geometry::TriMesh& mesh) {
  std::vector<Side> sides;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::uint8_t k = 0; k < 3; ++k) {
      const Index u = mesh.triangles[t][k], v = mesh.triangles[t][(k + 1) % 3];
      sides.push_back({std::min(u, v), std::max(u, v), t, k, u < v});
    }
  std::ranges::stable_sort(sides, {}, &Side::ends);
  return sides;
}

// Turns the triangles of each surface like its first one, along the edges that join them.
void turn(const std::vector<std::array<bool, 3>>& against, Joints& joints) {
  std::vector<bool> met(joints.across.size(), false);
  std::vector<std::uint32_t> stack;
  for (std::uint32_t first = 0; first < joints.across.size(); ++first) {
    if (met[first]) continue;
    met[first] = true;
    stack.push_back(first);
    while (!stack.empty()) {
      const std::uint32_t t = stack.back();
      stack.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t next = joints.across[t][k];
        if (next == kNoTriangle || met[next]) continue;
        met[next] = true;
        joints.turned[next] = joints.turned[t] != against[t][k];
        stack.push_back(next);
      }
    }
  }
}

}  // namespace

Joints find_joints(const geometry::TriMesh& mesh) {
  const std::size_t count = mesh.triangles.size();
  Joints joints;
  joints.across.assign(count, {kNoTriangle, kNoTriangle, kNoTriangle});
  joints.owned.assign(count, 0), joints.turned.assign(count, false);
  std::vector<std::array<bool, 3>> against(count);
  const std::vector<Side> sides = sorted_sides(mesh);
  for (std::size_t first = 0, next = 0; first < sides.size(); first = next) {
    while (next < sides.size() && sides[next].ends() == sides[first].ends()) ++next;
    const Side& s = sides[first];
    joints.owned[s.triangle] |= static_cast<std::uint8_t>(1u << s.edge);
    if (next - first != 2) continue;
    const Side& t = sides[first + 1];
    joints.across[s.triangle][s.edge] = t.triangle, joints.across[t.triangle][t.edge] = s.triangle;
    against[s.triangle][s.edge] = against[t.triangle][t.edge] = s.forward == t.forward;
  }
  turn(against, joints);
  return joints;
}

std::vector<std::vector<std::uint32_t>> split_into_patches(const Joints& joints,
                                                           const std::vector<std::uint32_t>& order,
                                                           const std::vector<std::size_t>& group,
                                                           std::size_t most) {
  std::vector<bool> met(order.size(), false);
  std::vector<std::vector<std::uint32_t>> patches;
  for (const std::uint32_t first : order) {
    if (met[first]) continue;
    std::vector<std::uint32_t>& patch = patches.emplace_back(1, first);
    met[first] = true;
    for (std::size_t k = 0; k < patch.size(); ++k)
      for (const std::uint32_t next : joints.across[patch[k]]) {
        if (next == kNoTriangle || met[next] || group[next] != group[first] || patch.size() == most) continue;
        met[next] = true;
        patch.push_back(next);
      }
  }
  return patches;
}

}  // namespace bodice::cloth
