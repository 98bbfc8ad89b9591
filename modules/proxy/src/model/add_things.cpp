#include <bodice/proxy/add_things.hpp>

#include <cmath>
#include <memory>
#include <string>

namespace bodice::inline v0_1::proxy {
namespace {

/// The stature of a proxy is rounded, so that a margin which goes with it may differ in its last bits where a
/// thing was fitted with that stature; a share of it.
constexpr double kSameMargin = 1e-9;

engine::Error unlike(const char* what, std::size_t thing) {
  return {engine::ErrorCode::kInvalidArgument,
          "Thing " + std::to_string(thing + 1) + " has another " + what + " than the body.",
          "Fit it with the body's stature for its scale."};
}

engine::Result<void> check_alike(const BodyProxy& body, const BodyProxy& thing, std::size_t index) {
  if (thing.relief().empty() != body.relief().empty())
    return engine::Error{engine::ErrorCode::kInvalidArgument,
                         "Of the body and thing " + std::to_string(index + 1) + " only one has relief.",
                         "Fit both with tier relief, or neither."};
  if (thing.stature_m() != body.stature_m()) return unlike("stature", index);
  if (std::abs(thing.margin_m() - body.margin_m()) > kSameMargin * body.stature_m())
    return unlike("margin", index);
  return {};
}

void add_shapes(const BodyProxy& thing, std::int16_t bone, BodyProxy::Data& data) {
  const auto texels = static_cast<std::uint32_t>(data.texels.size());
  for (ProxyEllipsoid e : thing.ellipsoids()) {
    e.bone = bone;
    data.ellipsoids.push_back(e);
  }
  for (ReliefTable table : thing.relief()) {
    table.first_texel += texels;
    data.relief.push_back(table);
  }
  data.texels.insert(data.texels.end(), thing.texels().begin(), thing.texels().end());
}

/// The term that leaves an ellipsoid where it is as long as its joint does not move.
CarryTerm still_term(std::uint16_t joint) {
  CarryTerm term{.joint = joint};
  for (std::size_t i = 0; i < 4; ++i) term.matrix[5 * i] = 1.0;
  return term;
}

/// Binds the ellipsoids that the body does not have to a joint more, which leaves their tables alone.
std::shared_ptr<const Binding> extended(const Binding& binding, std::size_t ellipsoids, std::size_t texels) {
  auto more = std::make_shared<Binding>(binding);
  const auto joint = static_cast<std::uint16_t>(more->bind.size());
  more->joint_names.emplace_back(kStillJoint);
  JointMatrix& still = more->bind.emplace_back();
  still.setZero();
  still.leftCols<3>().setIdentity();
  for (std::size_t k = binding.step_m.size(); k < ellipsoids; ++k) {
    more->terms.push_back(still_term(joint));
    more->first_term.push_back(static_cast<std::uint32_t>(more->terms.size()));
    more->step_m.push_back(1.0f);
    more->first_bundle.push_back(more->first_bundle.back());
    more->first_follower.push_back(0);
  }
  more->burial.resize(texels, 0);
  return more;
}

}  // namespace

engine::Result<BodyProxy> add_things(const BodyProxy& body, std::span<const BodyProxy> things) {
  BodyProxy::Data data = body.data();
  const std::size_t joints = data.binding ? data.binding->bind.size() : 0;
  const std::int16_t bone = data.binding && joints <= INT16_MAX ? static_cast<std::int16_t>(joints) : kNoBone;
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (auto alike = check_alike(body, things[i], i); !alike) return std::move(alike).error();
    add_shapes(things[i], bone, data);
  }
  if (data.binding) data.binding = extended(*data.binding, data.ellipsoids.size(), data.texels.size());
  return BodyProxy::make(std::move(data));
}

BasePose with_things(const BasePose& of_body, const BodyProxy& all) {
  BasePose base = of_body;
  const auto tables = all.relief().subspan(of_body.relief.size());
  const auto texels = all.texels().subspan(of_body.texels.size());
  base.joints.push_back(all.binding()->bind.back());
  base.relief.insert(base.relief.end(), tables.begin(), tables.end());
  base.texels.insert(base.texels.end(), texels.begin(), texels.end());
  return base;
}

}  // namespace bodice::proxy
