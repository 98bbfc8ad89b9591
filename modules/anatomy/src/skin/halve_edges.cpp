#include "skin/halve_edges.hpp"

namespace bodice::inline v0_1::anatomy {

using geometry::Index;

FinerSkin halve_edges(const Skin& skin) {
  FinerSkin fine{{skin.mesh.positions, {}}, {}};
  for (const auto& [a, b] : skin.edges.ends) {
    fine.mesh.positions.push_back(0.5 * (skin.mesh.positions[a] + skin.mesh.positions[b]));
    fine.origin.push_back(a);
  }
  const auto first = static_cast<Index>(skin.mesh.positions.size());
  fine.mesh.triangles.reserve(4 * skin.mesh.triangles.size());
  for (std::size_t f = 0; f < skin.mesh.triangles.size(); ++f) {
    const auto [a, b, c] = skin.mesh.triangles[f];
    const auto& edge = skin.edges.of_triangle[f];
    const Index ab = first + edge[0], bc = first + edge[1], ca = first + edge[2];
    fine.mesh.triangles.insert(fine.mesh.triangles.end(),
                               {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return fine;
}

}  // namespace bodice::anatomy
