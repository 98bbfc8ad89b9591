#include "selfcontact/loose.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

constexpr std::uint8_t kTight = 0, kLoose = 1, kWasLoose = 2;

template <class Visit>
void for_each_neighbor(const ContactMesh& mesh, Index i, Visit&& visit) {
  for (const std::uint32_t f : mesh.star_of(i))
    for (const Index j : mesh.faces[f].particle) visit(j);
}

}  // namespace

Loose make_loose(std::size_t particles) {
  Loose loose;
  loose.state.assign(particles, kTight);
  loose.list.reserve(particles), loose.released.reserve(particles);
  return loose;
}

void loosen(const ContactMesh& mesh, std::span<const Tangle> tangles, Loose& loose) {
  std::swap(loose.list, loose.released);
  loose.list.clear();
  for (const Index i : loose.released) loose.state[i] = kWasLoose;
  const auto add = [&](Index i) {
    if (loose.state[i] == kLoose) return;
    loose.state[i] = kLoose;
    loose.list.push_back(i);
  };
  for (const Tangle& t : tangles)
    for (const std::uint32_t face : {t.a, t.b})
      for (const Index i : mesh.faces[face].particle) for_each_neighbor(mesh, i, add);
  for (std::size_t k = 0; k < loose.list.size(); ++k)
    for_each_neighbor(mesh, loose.list[k], [&](Index j) {
      if (loose.state[j] == kWasLoose) add(j);
    });
  for (const Index i : loose.released)
    if (loose.state[i] == kWasLoose) loose.state[i] = kTight;
}

}  // namespace bodice::cloth
