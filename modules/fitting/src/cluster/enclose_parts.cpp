#include <bodice/fitting/enclose_parts.hpp>

#include <bodice/engine/catch_canceled.hpp>
#include <bodice/engine/parallel.hpp>
#include <bodice/fitting/mvee.hpp>

#include "base/check_input.hpp"
#include "base/skin_hash.hpp"
#include "cluster/refinement.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

/// #V: a bit for each part that must hold the vertex in its ellipsoid.
std::vector<std::uint32_t> holders(const LabeledSkin& skin) {
  std::vector<std::uint32_t> bits(skin.mesh.positions.size(), 0);
  for (const geometry::Triangle& t : skin.mesh.triangles) {
    std::uint32_t all = 0;
    for (const geometry::Index v : t) all |= 1u << static_cast<unsigned>(skin.part[v]);
    for (const geometry::Index v : t) bits[v] |= all;
  }
  return bits;
}

engine::Result<proxy::BodyProxy> enclose_checked(const engine::Context& context, const LabeledSkin& skin,
                                                 std::uint32_t parts) {
  // The gap is centimeters anyway, so that a volume within a percent of the least will do.
  const MveeOptions loose{.volume_tolerance = 1e-2, .min_radius_m = kLeastRadius * skin.stature_m};
  const std::vector<std::uint32_t> bits = holders(skin);
  std::vector<std::vector<Vec3>> points(body::kAllPartCount);
  std::vector<geometry::Ellipsoid> shapes(body::kAllPartCount);
  engine::parallel_for(context, body::kAllPartCount, 1, [&](std::size_t part, std::size_t) {
    if (!(parts & 1u << part)) return;
    for (std::size_t v = 0; v < bits.size(); ++v)
      if (bits[v] & 1u << part) points[part].push_back(skin.mesh.positions[v]);
    if (!points[part].empty()) shapes[part] = mvee(points[part], loose).ellipsoid;
  });
  proxy::BodyProxy::Data data;
  data.tier = proxy::Tier::kSolid;
  data.stature_m = skin.stature_m;
  data.frame = skin.frame;
  data.source_hash = skin_hash(skin.mesh);
  for (std::size_t part = 0; part < points.size(); ++part)
    if (!points[part].empty()) data.ellipsoids.push_back({shapes[part], static_cast<body::Part>(part)});
  if (data.ellipsoids.empty()) return no_skin();
  return proxy::BodyProxy::make(std::move(data));
}

}  // namespace

engine::Result<proxy::BodyProxy> enclose_parts(const engine::Context& context, const LabeledSkin& skin,
                                               std::uint32_t parts) {
  if (auto ok = check_input(skin, {.parts = parts}); !ok) return ok.error();
  return engine::catch_canceled("The enclosing of the parts",
                                [&] { return enclose_checked(context, skin, parts); });
}

}  // namespace bodice::fitting
