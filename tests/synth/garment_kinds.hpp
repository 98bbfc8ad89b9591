#pragma once

#include <array>

#include <bodice/synth/garment.hpp>

namespace bodice_test {

inline constexpr std::array kAllKinds = {
    bodice::synth::GarmentKind::kSkirt, bodice::synth::GarmentKind::kTunic,
    bodice::synth::GarmentKind::kPoncho, bodice::synth::GarmentKind::kTube};

}  // namespace bodice_test
