// Where an edge of the cloth passes through a triangle.
#pragma once

#include <span>

#include "pairs/pairs.hpp"

namespace bodice::inline v0_1::cloth {

/// Where an edge passes through a triangle: weights of the edge's ends and of the triangle's corners.
struct Passage {
  bool passes = false;
  float edge[2], face[3];
};

/// The passage of the edge from `p` to `q` through the triangle `a`, `b`, `c`.
Passage passage(Float4 p, Float4 q, Float4 a, Float4 b, Float4 c);

inline Float4 at_particle(std::span<const Point> at, Index i) {
  return xyz(load(at[i]));
}

inline bool contains(const Face& f, Index i) {
  return f.particle[0] == i || f.particle[1] == i || f.particle[2] == i;
}

/// Calls visit(k, passage) for each edge k of `of`, which begins at corner k, that passes through `face` and
/// shares no particle with it.
template <class Visit>
void for_each_passage(const Face& of, const Face& face, std::span<const Point> at, Visit&& visit) {
  for (unsigned k = 0; k < 3; ++k) {
    const Index p = of.particle[k], q = of.particle[(k + 1) % 3];
    if (contains(face, p) || contains(face, q)) continue;
    const Passage through = passage(at_particle(at, p), at_particle(at, q), at_particle(at, face.particle[0]),
                                    at_particle(at, face.particle[1]), at_particle(at, face.particle[2]));
    if (through.passes) visit(k, through);
  }
}

}  // namespace bodice::cloth
