// Based on: Robert W. Sumner, Johannes Schmid, Mark Pauly. Embedded Deformation for Shape Manipulation. 2007
// (affine maps of parts); Doug L. James, Christopher D. Twigg. Skinning Mesh Animations. 2005 (least-squares
// maps of skin).
// Differs: the maps are sums of constant matrices with the joints' matrices, so that no skin is touched in a
// frame, and tables of heights follow what an affine map leaves.
#include <bodice/binding/bind.hpp>

#include <memory>
#include <string>

#include <bodice/engine/catch_canceled.hpp>
#include <bodice/engine/parallel.hpp>

#include "bind/burial.hpp"
#include "bind/carry_terms.hpp"
#include "bind/exercises.hpp"
#include "bind/skin_nodes.hpp"
#include "tolerances.hpp"

namespace bodice::inline v0_1::binding {
namespace {

engine::Error refused(std::string what, std::string remedy) {
  return {engine::ErrorCode::kInvalidArgument, "Binding: " + std::move(what) + ".", std::move(remedy)};
}

/// What is found of one ellipsoid, in parallel.
struct BoundEllipsoid {
  std::vector<proxy::CarryTerm> terms;
  std::vector<SkinNode> nodes;
};

std::vector<BoundEllipsoid> bind_ellipsoids(const engine::Context& context, const proxy::BodyProxy& proxy,
                                            const SkinnedBody& body) {
  const double scale = proxy.stature_m() > 0.0 ? proxy.stature_m() / kReferenceStature_m : 1.0;
  const auto owned = owned_skin(context, proxy.ellipsoids(), body.skin, kOwnedBand_m * scale);
  const geometry::MeshDistance distance(context, body.skin);
  const std::vector<TurnedPose> poses = turned_poses(context, body);
  const NodeSearch search{proxy, body, distance, scale};
  std::vector<BoundEllipsoid> found(proxy.ellipsoids().size());
  engine::parallel_for(context, found.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      found[k].terms = carry_terms(proxy.ellipsoids()[k].shape, body, owned[k]);
      const int n = proxy.relief().empty() ? 0 : proxy.relief()[k].nodes_per_side;
      if (n < 2 || n > proxy::kMostBoundNodes) continue;
      if (departure(found[k].terms, poses, body, owned[k]) < kStiff_m * scale) continue;
      found[k].nodes = find_nodes(search, k);
    }
  });
  return found;
}

proxy::BodyProxy::Data bound_data(const engine::Context& context, const proxy::BodyProxy& proxy,
                                  const SkinnedBody& body) {
  std::vector<BoundEllipsoid> found = bind_ellipsoids(context, proxy, body);
  auto binding = std::make_shared<proxy::Binding>();
  for (const rig::Joint& joint : body.skeleton.joints) {
    binding->joint_names.push_back(joint.name);
    binding->bind.push_back(joint.bind);
  }
  binding->first_term = {0};
  binding->first_bundle = {0};
  binding->first_entry = {0};
  proxy::BodyProxy::Data data = proxy.data();
  for (std::size_t k = 0; k < found.size(); ++k) {
    binding->terms.insert(binding->terms.end(), found[k].terms.begin(), found[k].terms.end());
    binding->first_term.push_back(static_cast<std::uint32_t>(binding->terms.size()));
    add_nodes(std::move(found[k].nodes), data.ellipsoids[k].shape.radii.maxCoeff(),
              data.relief.empty() ? 0 : data.relief[k].nodes_per_side, *binding);
    const std::uint16_t joint = found[k].terms.front().joint;
    data.ellipsoids[k].bone = joint <= INT16_MAX ? static_cast<std::int16_t>(joint) : proxy::kNoBone;
  }
  Burial burial = find_burial(context, proxy);
  raise_burial(context, proxy, *binding, body, exercises(body, body.part), burial);
  binding->burial = std::move(burial.depth);
  binding->burial_step_m = burial.step_m;
  data.binding = std::move(binding);
  return data;
}

}  // namespace

engine::Result<proxy::BodyProxy> bind(const engine::Context& context, const proxy::BodyProxy& proxy,
                                      const SkinnedBody& body) {
  if (body.skeleton.joints.empty())
    return refused("the rig has no joints", "Bind to a skeleton, or keep the proxy unbound.");
  if (body.skin.positions.empty() || body.weights.vertices() != body.skin.positions.size())
    return refused("there are skin weights for " + std::to_string(body.weights.vertices()) +
                       " vertices, and the skin has " + std::to_string(body.skin.positions.size()),
                   "Give the weights of the same skin, after repair.");
  return engine::catch_canceled("Binding", [&]() -> engine::Result<proxy::BodyProxy> {
    return proxy::BodyProxy::make(bound_data(context, proxy, body));
  });
}

}  // namespace bodice::binding
