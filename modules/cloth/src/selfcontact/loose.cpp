#include "selfcontact/loose.hpp"

namespace bodice::inline v0_1::cloth {

Loose make_loose(std::size_t particles) {
  Loose loose;
  loose.is_loose.assign(particles, 0);
  loose.list.reserve(particles);
  return loose;
}

void loosen(const ContactMesh& mesh, std::span<const Tangle> tangles, Loose& loose) {
  for (const Index i : loose.list) loose.is_loose[i] = 0;
  loose.list.clear();
  for (const Tangle& t : tangles)
    for (const std::uint32_t face : {t.a, t.b})
      for (const Index i : mesh.faces[face].particle) {
        if (!loose.is_loose[i]) loose.list.push_back(i);
        loose.is_loose[i] = 1;
      }
}

}  // namespace bodice::cloth
