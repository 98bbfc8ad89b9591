#include <bodice/tryon/wardrobe.hpp>

namespace bodice::tryon {

Wardrobe join(const std::vector<WornGarment>& garments) {
  Wardrobe all;
  for (const WornGarment& garment : garments) {
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
