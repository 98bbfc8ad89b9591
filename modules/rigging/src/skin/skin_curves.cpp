#include "skin/skin_curves.hpp"

#include <algorithm>
#include <functional>

namespace bodice::inline v0_1::rigging {
namespace {

const geodesic::Isoline* longest(const std::vector<geodesic::Isoline>& curves,
                                 const std::function<bool(const geodesic::Isoline&)>& counts) {
  const geodesic::Isoline* best = nullptr;
  for (const geodesic::Isoline& curve : curves)
    if (counts(curve) && (best == nullptr || curve.girth_m > best->girth_m)) best = &curve;
  return best;
}

}  // namespace

PartSet parts(std::initializer_list<body::Part> list) {
  PartSet set;
  for (const body::Part part : list) set.set(static_cast<std::size_t>(part));
  return set;
}

SkinCurves::SkinCurves(const engine::Context& context, const geometry::TriMesh& skin,
                       const anatomy::Anatomy& anatomy)
    : skin_(skin),
      anatomy_(anatomy),
      edges_(geometry::mesh_edges(skin)),
      solver_(context, skin_, edges_, geodesic::Method::kUnfolded) {}

std::optional<Ring> SkinCurves::border(const PartSet& inside) const {
  std::vector<float> field(skin_.positions.size());
  for (geometry::Index v = 0; v < field.size(); ++v) field[v] = is_in(v, inside) ? 1.0F : -1.0F;
  const std::vector<float> levels = {0.0F};
  const auto curves = geodesic::isolines(skin_, edges_, field, levels);
  // An open curve ends at a hole of the skin; it counts where nothing is closed.
  const auto* curve = longest(curves[0], [](const geodesic::Isoline& c) { return c.closed; });
  if (curve == nullptr) curve = longest(curves[0], [](const geodesic::Isoline&) { return true; });
  if (curve == nullptr) return std::nullopt;
  return Ring{curve->centroid, curve->girth_m};
}

std::optional<Ring> SkinCurves::ring(const geodesic::Field& field, double level,
                                     const PartSet& within) const {
  const std::vector<float> levels = {static_cast<float>(level)};
  const auto curves = geodesic::isolines(skin_, edges_, field, levels);
  const auto* curve = longest(curves[0], [&](const geodesic::Isoline& c) {
    const auto in = std::count_if(c.edges.begin(), c.edges.end(), [&](geometry::Index e) {
      return is_in(edges_.ends[e][0], within) && is_in(edges_.ends[e][1], within);
    });
    return c.closed && 2 * static_cast<std::size_t>(in) > c.edges.size();
  });
  if (curve == nullptr) return std::nullopt;
  return Ring{curve->centroid, curve->girth_m};
}

}  // namespace bodice::rigging
