#include "posed.hpp"

#include <doctest/doctest.h>

namespace posed {

using namespace bodice;

synth::Body made_body(const synth::BodyOptions& options) {
  auto body = synth::make_body({}, options);
  REQUIRE_MESSAGE(body.ok(), (body.ok() ? "" : body.error().sentence()));
  return std::move(body).value();
}

rig::Clip made_clip(const rig::Skeleton& skeleton, rigging::Motion motion,
                    const rigging::MotionOptions& options) {
  auto clip = rigging::make_clip(skeleton, motion, options);
  REQUIRE_MESSAGE(clip.ok(), (clip.ok() ? "" : clip.error().sentence()));
  return std::move(clip).value();
}

std::vector<Affine> joints_at(const rig::Skeleton& skeleton, const rig::Clip& clip, double time_s) {
  std::vector<Affine> world(skeleton.joints.size());
  rig::joint_matrices(skeleton, clip, time_s, world);
  return world;
}

Vec3 position(const rig::Skeleton& skeleton, const std::vector<Affine>& world, std::string_view joint) {
  const auto found = rig::find_joint(skeleton, joint);
  REQUIRE(found.has_value());
  return world[*found].col(3);
}

std::vector<Vec3> skin_at(const synth::Body& body, const rig::Clip& clip, double time_s) {
  std::vector<Affine> skinning(body.skeleton.joints.size());
  rig::skinning_matrices(body.skeleton, joints_at(body.skeleton, clip, time_s), skinning);
  std::vector<Vec3> skin(body.mesh.positions.size());
  rig::skin_linear(body.mesh.positions, body.weights, skinning, skin);
  return skin;
}

std::vector<std::size_t> vertices_of(const synth::Body& body, std::string_view joint) {
  std::vector<std::size_t> found;
  for (std::size_t v = 0; v < body.weights.vertices(); ++v)
    for (auto k = body.weights.first[v]; k < body.weights.first[v + 1]; ++k)
      if (body.weights.weight[k] > 0.5f && body.skeleton.joints[body.weights.joint[k]].name == joint)
        found.push_back(v);
  return found;
}

}  // namespace posed
