#include "rig.hpp"

#include <stdexcept>

#include <bodice/io/rig.hpp>

namespace bench {
namespace {

using bodice::geometry::Index;
using bodice::geometry::kNoIndex;
using bodice::geometry::TriMesh;
using bodice::geometry::Vec3;
using bodice::rig::SkinWeights;

/// How much of a vertex follows the bone.
double share_of(const SkinWeights& weights, std::size_t vertex, std::size_t bone) {
  double share = 0.0;
  for (std::uint32_t e = weights.first[vertex]; e < weights.first[vertex + 1]; ++e)
    share += weights.joint[e] == bone ? static_cast<double>(weights.weight[e]) : 0.0;
  return share;
}

/// The skin of a file and its weights with the vertices in the file's order. The body is the file's first
/// mesh, so that its vertices are the first ones of the input.
void put_in_file_order(const bodice::io::ImportedMesh& body, const SkinWeights& weights, Rig& rig) {
  const std::size_t vertices = body.skin.positions.size();
  std::vector<Index> input_of(vertices, kNoIndex);
  rig.weights.first.push_back(0);
  for (std::size_t i = 0; i < vertices; ++i) {
    const Index v = body.vertex_of_input[i];
    if (v == kNoIndex || input_of[v] != kNoIndex)
      throw std::runtime_error(body.file.string() + ": vertex " + std::to_string(i) +
                               " was joined with another, so that labels by vertex do not fit.");
    input_of[v] = static_cast<Index>(i);
    rig.rest.positions.push_back(body.skin.positions[v]);
    for (std::uint32_t e = weights.first[v]; e < weights.first[v + 1]; ++e) {
      rig.weights.joint.push_back(weights.joint[e]);
      rig.weights.weight.push_back(weights.weight[e]);
    }
    rig.weights.first.push_back(static_cast<std::uint32_t>(rig.weights.joint.size()));
  }
  for (const auto& t : body.skin.triangles)
    rig.rest.triangles.push_back({input_of[t[0]], input_of[t[1]], input_of[t[2]]});
}

}  // namespace

Rig read_rig(const std::filesystem::path& file) {
  const auto read = bodice::io::import_rigged_body({}, file, {.mesh = "body"});
  if (!read) throw std::runtime_error(read.error().sentence());
  if (!read->rig) throw std::runtime_error(read->rig.error().sentence());
  Rig rig;
  for (const auto& joint : read->rig->skeleton.joints)
    rig.bones.push_back({joint.name, joint.parent, joint.bind.col(3)});
  put_in_file_order(read->body, read->rig->weights, rig);
  return rig;
}

Rig moved_into(const Rig& rig, const TriMesh& rest) {
  Rig moved = rig;
  moved.rest.positions = rest.positions;
  for (std::size_t b = 0; b < rig.bones.size(); ++b) {
    const int parent = rig.bones[b].parent;
    Vec3 shift = Vec3::Zero();
    double all = 0.0;
    for (std::size_t v = 0; v < rest.positions.size(); ++v) {
      const double own = share_of(rig.weights, v, b);
      const double shared =
          parent < 0 ? own : own * share_of(rig.weights, v, static_cast<std::size_t>(parent));
      shift += shared * (rest.positions[v] - rig.rest.positions[v]);
      all += shared;
    }
    if (all > 0.0)
      moved.bones[b].head += shift / all;
    else if (parent >= 0)
      moved.bones[b].head += moved.bones[static_cast<std::size_t>(parent)].head -
                             rig.bones[static_cast<std::size_t>(parent)].head;
  }
  return moved;
}

std::vector<Eigen::Affine3d> pose_bones(const Rig& rig, const std::vector<Eigen::Quaterniond>& turns) {
  std::vector<Eigen::Affine3d> pose(rig.bones.size());
  for (std::size_t b = 0; b < pose.size(); ++b) {
    const Bone& bone = rig.bones[b];
    const Eigen::Affine3d about_head =
        Eigen::Translation3d(bone.head) * turns[b] * Eigen::Translation3d(-bone.head);
    pose[b] = bone.parent < 0 ? about_head : pose[static_cast<std::size_t>(bone.parent)] * about_head;
  }
  return pose;
}

TriMesh pose_skin(const Rig& rig, const std::vector<Eigen::Affine3d>& bones) {
  std::vector<bodice::rig::Affine> moves;
  for (const Eigen::Affine3d& bone : bones)
    moves.push_back(bodice::rig::affine(bone.linear(), bone.translation()));
  TriMesh posed = rig.rest;
  bodice::rig::skin_linear(rig.rest.positions, rig.weights, moves, posed.positions);
  return posed;
}

}  // namespace bench
