#include <bodice/binding/flexed_skin.hpp>

#include <array>

#include "bind/bends.hpp"

namespace bodice::inline v0_1::binding {

using body::Part;

std::vector<Vec3> flexed_skin(const engine::Context& context, const SkinnedBody& body,
                              std::span<const Part> part) {
  if (part.size() != body.skin.positions.size() || body.weights.vertices() != part.size()) return {};
  const Limbs limbs(body, part);
  const Vec3& front = limbs.directions().front;
  // These are half of the angles that sitting, running and raised arms need.
  const std::array<Bend, 8> bends = {{{Part::kThighL, front, 31.0, Part::kThighL},
                                      {Part::kThighR, front, 31.0, Part::kThighR},
                                      {Part::kCalfL, -front, 45.0, Part::kThighL},
                                      {Part::kCalfR, -front, 45.0, Part::kThighR},
                                      {Part::kUpperArmL, front, 35.0, Part::kUpperArmL},
                                      {Part::kUpperArmR, front, 35.0, Part::kUpperArmR},
                                      {Part::kForearmL, front, 40.0, Part::kUpperArmL},
                                      {Part::kForearmR, front, 40.0, Part::kUpperArmR}}};
  const auto skinning = limbs.bent(bends);
  if (!skinning) return {};
  std::vector<Vec3> flexed(part.size());
  rig::skin_linear(context, body.skin.positions, body.weights, *skinning, flexed);
  return flexed;
}

}  // namespace bodice::binding
