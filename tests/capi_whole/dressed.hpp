// A made body and a skirt cut to it.
#pragma once

#include <bodice/tryon/prepare.hpp>
#include <bodice/tryon/wearing.hpp>

#include "capi_whole/body.hpp"

namespace capi_test {

/// A made body and a skirt cut to it, for C and for C++.
struct Dressed {
  bodice::synth::Body body = make_body();
  bodice::tryon::SegmentedSkin skin;
  bodice::tryon::WornGarment skirt;

  Dressed() {
    auto input = bodice::tryon::repair_body({}, body.mesh);
    skin = std::move(bodice::tryon::segment_mesh({}, std::move(*input), {})).value();
    auto made = bodice::tryon::make_garment({}, skin, {.edge_length_m = 0.03});
    REQUIRE(made);
    skirt = std::move(made).value();
  }
  bodice_garment garment(const bodice_mesh& mesh) const {
    bodice_garment worn = bodice_default_garment();
    worn.name = "skirt";
    worn.mesh = &mesh;
    worn.held = skirt.held.data();
    worn.held_count = skirt.held.size();
    return worn;
  }
};

}  // namespace capi_test
