#include "worn.hpp"

#include "must.hpp"

namespace tradeoff {

bodice::tryon::WornGarment cut_for(const bodice::engine::Context& context, const Subject& subject,
                                   const GarmentChoice& choice, double edge_m) {
  const auto& skin = subject.skin;
  auto cut = must(bodice::synth::make_garment(context,
                                              {.mesh = skin.input.skin,
                                               .part = skin.anatomy.part,
                                               .landmarks = skin.anatomy.landmarks,
                                               .stature_m = skin.anatomy.stature_m},
                                              {.kind = choice.kind, .edge_length_m = edge_m}));
  return {.name = choice.name, .mesh = std::move(cut.mesh), .held = std::move(cut.pinned)};
}

}  // namespace tradeoff
