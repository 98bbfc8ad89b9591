#pragma once

#include <map>
#include <string>

#include <bodice/synth/garment.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bodice::cli {

/// The kinds of made garments, by their names in options.
inline const std::map<std::string, synth::GarmentKind>& garment_kinds() {
  static const std::map<std::string, synth::GarmentKind> kinds = {{"skirt", synth::GarmentKind::kSkirt},
                                                                  {"tunic", synth::GarmentKind::kTunic},
                                                                  {"poncho", synth::GarmentKind::kPoncho},
                                                                  {"tube", synth::GarmentKind::kTube}};
  return kinds;
}

inline engine::Result<synth::Garment> make_garment_for(const engine::Context& context,
                                                       const tryon::SegmentedSkin& skin,
                                                       const std::string& kind) {
  const synth::SegmentedBody body{.mesh = skin.input.skin,
                                  .part = skin.anatomy.part,
                                  .landmarks = skin.anatomy.landmarks,
                                  .stature_m = skin.anatomy.stature_m};
  return synth::make_garment(context, body, {.kind = garment_kinds().at(kind)});
}

}  // namespace bodice::cli
