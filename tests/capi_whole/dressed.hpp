// A made body and a skirt cut to it.
#pragma once

#include <bodice/synth/garment.hpp>
#include <bodice/tryon/prepare.hpp>

#include "capi_whole/body.hpp"

namespace capi_test {

/// A made body and a skirt cut to it, for C and for C++.
struct Dressed {
  bodice::synth::Body body = make_body();
  bodice::tryon::SegmentedSkin skin;
  bodice::synth::Garment skirt;

  Dressed() {
    auto input = bodice::tryon::repair_body({}, body.mesh);
    skin = std::move(bodice::tryon::segment_mesh({}, std::move(*input), {})).value();
    auto made =
        bodice::synth::make_garment({},
                                    {.mesh = skin.input.skin,
                                     .part = skin.anatomy.part,
                                     .landmarks = skin.anatomy.landmarks,
                                     .stature_m = skin.anatomy.stature_m},
                                    {.kind = bodice::synth::GarmentKind::kSkirt, .edge_length_m = 0.03});
    REQUIRE(made);
    skirt = std::move(made).value();
  }
  bodice_garment garment(const bodice_mesh& mesh) const {
    bodice_garment worn = bodice_default_garment();
    worn.name = "skirt";
    worn.mesh = &mesh;
    worn.held = skirt.pinned.data();
    worn.held_count = skirt.pinned.size();
    return worn;
  }
};

}  // namespace capi_test
