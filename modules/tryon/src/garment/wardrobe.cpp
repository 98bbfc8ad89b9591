#include <bodice/tryon/wardrobe.hpp>

#include <bodice/engine/message.hpp>

#include "garment/check_garment.hpp"

namespace bodice::inline v0_1::tryon {
namespace {

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
