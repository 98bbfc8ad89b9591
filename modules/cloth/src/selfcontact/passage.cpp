#include "selfcontact/passage.hpp"

namespace bodice::inline v0_1::cloth {

Passage passage(Float4 p, Float4 q, Float4 a, Float4 b, Float4 c) {
  const Float4 normal = cross(b - a, c - a), along = q - p;
  const float from = dot(normal, p - a), to = dot(normal, q - a);
  if (!(from * to < 0.0f)) return {};
  const float wa = dot(along, cross(b - p, c - p)), wb = dot(along, cross(c - p, a - p)),
              wc = dot(along, cross(a - p, b - p));
  const bool inside = (wa > 0.0f && wb > 0.0f && wc > 0.0f) || (wa < 0.0f && wb < 0.0f && wc < 0.0f);
  if (!inside) return {};
  const float all = wa + wb + wc, t = from / (from - to);
  return {true, {1.0f - t, t}, {wa / all, wb / all, wc / all}};
}

}  // namespace bodice::cloth
