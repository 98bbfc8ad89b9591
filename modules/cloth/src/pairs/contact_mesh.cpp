#include "pairs/contact_mesh.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include <bodice/geometry/detail/morton.hpp>

#include "base/schedule.hpp"
#include "pairs/patches.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

std::vector<std::size_t> blocks_of(const geometry::TriMesh& mesh) {
  const std::size_t size = block_size(mesh.positions.size());
  std::vector<std::size_t> block;
  for (const auto& [a, b, c] : mesh.triangles)
    block.push_back(a / size == b / size && a / size == c / size ? a / size : kNoBlock);
  return block;
}

// The triangles by block, in each by the Morton code of their middle.
std::vector<std::uint32_t> spatial_order(const geometry::TriMesh& mesh,
                                         const std::vector<std::size_t>& block) {
  const geometry::Box box = geometry::bounding_box(mesh.positions);
  const double side = std::max(box.size().maxCoeff(), 1e-30);
  std::vector<std::uint32_t> code, order(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 middle = (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3.0;
    const auto cell = [&](int axis) {
      return static_cast<std::uint32_t>(1023.0 * std::clamp((middle[axis] - box.low[axis]) / side, 0.0, 1.0));
    };
    code.push_back(geometry::morton_code(cell(0), cell(1), cell(2)));
  }
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t t) { return std::pair(block[t], code[t]); });
  return order;
}

void add_leaf(const geometry::TriMesh& mesh, const Joints& joints, const std::vector<std::uint32_t>& patch,
              std::vector<bool>& owned, ContactMesh& out) {
  std::vector<Index> met;
  for (const std::uint32_t t : patch) {
    Face face{.edges = joints.owned[t], .turned = joints.turned[t]};
    for (std::size_t k = 0; k < 3; ++k) {
      const Index i = face.particle[k] = mesh.triangles[t][k];
      if (!owned[i]) face.particles |= static_cast<std::uint8_t>(1u << k);
      owned[i] = true;
      met.push_back(i);
    }
    out.faces.push_back(face);
    out.leaf_of.push_back(static_cast<std::uint32_t>(out.face_begin.size() - 1));
  }
  std::ranges::sort(met);
  const auto repeated = std::ranges::unique(met);
  out.particle.insert(out.particle.end(), met.begin(), repeated.begin());
  out.face_begin.push_back(static_cast<std::uint32_t>(out.faces.size()));
  out.particle_begin.push_back(static_cast<std::uint32_t>(out.particle.size()));
}

void find_stars(std::size_t particles, ContactMesh& out) {
  out.star_begin.assign(particles + 1, 0);
  for (const Face& f : out.faces)
    for (const Index i : f.particle) ++out.star_begin[i + 1];
  for (std::size_t i = 1; i < out.star_begin.size(); ++i) out.star_begin[i] += out.star_begin[i - 1];
  out.star.resize(out.star_begin.back());
  std::vector<std::uint32_t> next(out.star_begin.begin(), out.star_begin.end() - 1);
  for (std::uint32_t f = 0; f < out.faces.size(); ++f)
    for (const Index i : out.faces[f].particle) out.star[next[i]++] = f;
}

// A particle is simple if its triangles form one fan. Then all of its edges but at most two join two of them.
std::vector<bool> find_simple(const geometry::TriMesh& mesh, const Joints& joints) {
  std::vector<int> corners(mesh.positions.size(), 0), joined(mesh.positions.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      ++corners[a];
      if (joints.across[t][k] != kNoTriangle) ++joined[a], ++joined[b];
    }
  std::vector<bool> simple;
  for (std::size_t i = 0; i < corners.size(); ++i) simple.push_back(joined[i] / 2 + 1 >= corners[i]);
  return simple;
}

}  // namespace

ContactMesh make_contact_mesh(const geometry::TriMesh& mesh) {
  const std::vector<std::size_t> block = blocks_of(mesh);
  const Joints joints = find_joints(mesh);
  ContactMesh out;
  out.blocks = engine::block_count(mesh.positions.size(), block_size(mesh.positions.size()));
  out.face_begin.push_back(0), out.particle_begin.push_back(0);
  std::vector<bool> owned(mesh.positions.size(), false);
  for (const auto& patch : split_into_patches(joints, spatial_order(mesh, block), block, kLeaf)) {
    add_leaf(mesh, joints, patch, owned, out);
    out.block.push_back(block[patch.front()]);
  }
  find_stars(mesh.positions.size(), out);
  out.simple = find_simple(mesh, joints);
  return out;
}

bool are_joined(const ContactMesh& mesh, std::size_t leaf, std::size_t other) {
  if (leaf == other) return true;
  const std::span<const Index> a = mesh.particles_of(leaf), b = mesh.particles_of(other);
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i] == b[j] && mesh.simple[a[i]]) return true;
    a[i] < b[j] ? ++i : ++j;
  }
  return false;
}

}  // namespace bodice::cloth
