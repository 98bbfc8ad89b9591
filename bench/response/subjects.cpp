#include "subjects.hpp"

#include <cstdio>
#include <cstdlib>

#include <bodice/fitting/fit.hpp>
#include <bodice/geometry/mesh_distance.hpp>

namespace bench {

using namespace bodice;

proxy::BodyProxy fit_body(synth::Pose pose, std::uint64_t seed, proxy::Tier tier) {
  synth::BodyOptions options;
  options.pose = pose;
  options.seed = seed;
  options.vertices = 4500;
  auto body = synth::make_body({}, options);
  if (!body) std::puts(body.error().sentence().c_str()), std::exit(1);
  const geometry::MeshDistance skin({}, body->mesh);
  auto fit = fitting::fit(
      {}, {.mesh = body->mesh, .part = body->part, .stature_m = body->stature_m, .distance = &skin},
      {.tier = tier});
  if (!fit) std::puts(fit.error().sentence().c_str()), std::exit(1);
  return fit->proxy;
}

}  // namespace bench
