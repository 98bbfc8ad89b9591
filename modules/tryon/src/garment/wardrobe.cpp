#include <bodice/tryon/wardrobe.hpp>

#include <algorithm>

#include <bodice/engine/message.hpp>
#include <bodice/engine/parallel.hpp>

#include "garment/check_garment.hpp"

namespace bodice::tryon {
namespace {

constexpr double kHalfCloth_m = 0.5e-3;
constexpr double kLeastThickness_m = 1e-3;  // rounding, and the linear distances of cloth's contact
constexpr double kMostThickness_m = 8e-3;   // a wider gap is visible
constexpr double kErrorQuantile = 0.99;
constexpr double kNearSkin_m = 0.05;  // vertices farther away do not come to rest on the skin below them
constexpr std::size_t kGrain = 256;   // vertices a block: about a millisecond of closest points

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

std::vector<std::vector<TackedPiece>> add_tacks(const engine::Context& context,
                                                const std::vector<WornGarment>& garments, double within_m,
                                                Wardrobe& wardrobe) {
  std::vector<std::vector<TackedPiece>> pieces;
  for (std::size_t g = 0; g < garments.size(); ++g) {
    Tacking tacking = find_tacks(context, garments[g].mesh, within_m);
    const auto first = static_cast<geometry::Index>(wardrobe.first_vertex[g]);
    for (const cloth::Tack& tack : tacking.tacks) wardrobe.tacks.push_back({tack.a + first, tack.b + first});
    pieces.push_back(std::move(tacking.pieces));
  }
  return pieces;
}

engine::Result<cloth::Fabric> fabric_or_cotton(const std::optional<cloth::Fabric>& fabric) {
  if (fabric) return *fabric;
  return cloth::find_fabric("cotton");
}

double known_thickness_m(const engine::Context& context, const geometry::TriMesh& garment,
                         const geometry::MeshDistance& skin, const collision::Collider& collider) {
  const std::vector<geometry::Vec3>& at = garment.positions;
  std::vector<float> missed_m(at.size(), 0.0f);
  engine::parallel_for(context, at.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!at[i].allFinite()) continue;
      const geometry::Vec3 below = skin.closest_point(at[i]).point;
      if ((below - at[i]).norm() > kNearSkin_m) continue;
      const Eigen::Vector3f local = (below - collider.origin()).cast<float>();
      missed_m[i] = std::max(0.0f, collider.query({local.x(), local.y(), local.z()}).signed_distance);
    }
  });
  if (missed_m.empty()) return kLeastThickness_m;
  const auto rank = static_cast<std::ptrdiff_t>(kErrorQuantile * static_cast<double>(missed_m.size() - 1));
  std::nth_element(missed_m.begin(), missed_m.begin() + rank, missed_m.end());
  return std::clamp(kHalfCloth_m + double{missed_m[static_cast<std::size_t>(rank)]}, kLeastThickness_m,
                    kMostThickness_m);
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
