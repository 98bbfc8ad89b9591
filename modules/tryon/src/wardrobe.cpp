#include <bodice/tryon/wardrobe.hpp>

#include <algorithm>

#include <bodice/engine/message.hpp>
#include <bodice/engine/parallel.hpp>

#include "check_garment.hpp"

namespace bodice::tryon {
namespace {

constexpr double kClothThickness_m = 0.0015;
constexpr double kMostThickness_m = 0.008;  // a wider gap is visible
constexpr std::size_t kGrain = 256;         // vertices a block: about a millisecond of signed distances
// The radius of the tightest turns that cloth covers (thighs and upper arms), in statures.
constexpr double kLimbRadius = 0.03;

engine::Result<void> check(const WornGarment& garment, std::size_t number) {
  const std::string name = garment.name.empty() ? engine::message("Garment ", number) : garment.name;
  if (auto good = check_triangles(garment.mesh, name); !good) return good;
  for (const geometry::Index v : garment.held)
    if (v >= garment.mesh.positions.size())
      return engine::Error{engine::ErrorCode::kInvalidArgument,
                           engine::message(name, ": vertex ", v, " is held, but there are ",
                                           garment.mesh.positions.size(), " vertices."),
                           "Count a garment's own vertices, from zero."};
  return {};
}

}  // namespace

engine::Result<Wardrobe> join(const std::vector<WornGarment>& garments) {
  Wardrobe all;
  for (const WornGarment& garment : garments) {
    if (auto good = check(garment, all.first_vertex.size()); !good) return std::move(good).error();
    const auto offset = static_cast<geometry::Index>(all.mesh.positions.size());
    all.first_vertex.push_back(offset);
    all.mesh.positions.insert(all.mesh.positions.end(), garment.mesh.positions.begin(),
                              garment.mesh.positions.end());
    for (const geometry::Triangle& t : garment.mesh.triangles)
      all.mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
    for (const geometry::Index v : garment.held) all.held.push_back(v + offset);
  }
  all.first_vertex.push_back(all.mesh.positions.size());
  return all;
}

engine::Result<cloth::Fabric> fabric_or_cotton(const std::optional<cloth::Fabric>& fabric) {
  if (fabric) return *fabric;
  return cloth::find_fabric("cotton");
}

double covering_thickness_m(const geometry::TriMesh& garment, double stature_m) {
  std::vector<double> squared;
  for (std::size_t t = 0; t < garment.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const double length = (garment.corner(t, k) - garment.corner(t, (k + 1) % 3)).squaredNorm();
      if (length > 0.0 && length < stature_m * stature_m) squared.push_back(length);
    }
  if (squared.empty()) return kClothThickness_m;
  const auto long_edge = squared.begin() + static_cast<std::ptrdiff_t>(squared.size() * 9 / 10);
  std::nth_element(squared.begin(), long_edge, squared.end());
  return std::min(kMostThickness_m, kClothThickness_m + *long_edge / (8.0 * kLimbRadius * stature_m));
}

double fitted_thickness_m(const engine::Context& context, const geometry::TriMesh& garment,
                          const geometry::MeshDistance& skin, double stature_m) {
  const double covering = covering_thickness_m(garment, stature_m);
  const std::vector<geometry::Vec3>& at = garment.positions;
  std::vector<double> gap(at.size(), 0.0);
  engine::parallel_for(context, at.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (at[i].allFinite()) gap[i] = std::max(0.0, skin.signed_distance(at[i]));
  });
  if (gap.empty()) return covering;
  const auto median = gap.begin() + static_cast<std::ptrdiff_t>(gap.size() / 2);
  std::nth_element(gap.begin(), median, gap.end());
  return std::min(covering, std::max(kClothThickness_m, *median));
}

std::vector<geometry::Vec3> held_positions(const Wardrobe& wardrobe, const collision::Collider& collider,
                                           double thickness_m) {
  const std::size_t count = wardrobe.held.size();
  std::vector<float> x(count), y(count), z(count);
  for (std::size_t i = 0; i < count; ++i) {
    const geometry::Vec3 local = wardrobe.mesh.positions[wardrobe.held[i]] - collider.origin();
    x[i] = static_cast<float>(local.x());
    y[i] = static_cast<float>(local.y());
    z[i] = static_cast<float>(local.z());
  }
  collider.resolve({}, {.count = count, .x = x.data(), .y = y.data(), .z = z.data()},
                   {.thickness_m = static_cast<float>(thickness_m)});
  std::vector<geometry::Vec3> world(count);
  for (std::size_t i = 0; i < count; ++i)
    world[i] = collider.origin() + geometry::Vec3(double{x[i]}, double{y[i]}, double{z[i]});
  return world;
}

}  // namespace bodice::tryon
