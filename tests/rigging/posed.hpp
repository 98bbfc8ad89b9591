// Made bodies, and their joints and skins at moments of a motion.
#pragma once

#include <string_view>

#include <bodice/rig/rig.hpp>
#include <bodice/rigging/motion.hpp>
#include <bodice/synth/body.hpp>

namespace posed {

using bodice::geometry::Vec3;
using bodice::rig::Affine;

bodice::synth::Body made_body(const bodice::synth::BodyOptions& options);

bodice::rig::Clip made_clip(const bodice::rig::Skeleton& skeleton, bodice::rigging::Motion motion,
                            const bodice::rigging::MotionOptions& options = {});

std::vector<Affine> joints_at(const bodice::rig::Skeleton& skeleton, const bodice::rig::Clip& clip,
                              double time_s);

Vec3 position(const bodice::rig::Skeleton& skeleton, const std::vector<Affine>& world,
              std::string_view joint);

std::vector<Vec3> skin_at(const bodice::synth::Body& body, const bodice::rig::Clip& clip, double time_s);

/// Vertices on which the joint of this name has more than half of the weight.
std::vector<std::size_t> vertices_of(const bodice::synth::Body& body, std::string_view joint);

}  // namespace posed
