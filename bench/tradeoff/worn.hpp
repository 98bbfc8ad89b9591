#pragma once

#include <string>

#include <bodice/synth/garment.hpp>
#include <bodice/tryon/wardrobe.hpp>

#include "bodies.hpp"

namespace tradeoff {

/// A kind of made garment with its name.
struct GarmentChoice {
  const char* name;
  bodice::synth::GarmentKind kind;
};
inline constexpr GarmentChoice kGarments[] = {{"skirt", bodice::synth::GarmentKind::kSkirt},
                                              {"tunic", bodice::synth::GarmentKind::kTunic},
                                              {"poncho", bodice::synth::GarmentKind::kPoncho}};

/// A garment cut to fit the body, with its pinned vertices.
bodice::tryon::WornGarment cut_for(const bodice::engine::Context& context, const Subject& subject,
                                   const GarmentChoice& choice, double edge_m);

}  // namespace tradeoff
