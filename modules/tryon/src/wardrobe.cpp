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

}  // namespace bodice::tryon
