#pragma once

#include <map>
#include <string>

#include <bodice/synth/garment.hpp>

namespace bodice::inline v0_1::cli {

/// The kinds of made garments, by their names in options.
inline const std::map<std::string, synth::GarmentKind>& garment_kinds() {
  static const auto kinds = [] {
    using enum synth::GarmentKind;
    std::map<std::string, synth::GarmentKind> by_name;
    for (const auto kind : {kSkirt, kTunic, kPoncho, kTube}) by_name.emplace(name(kind), kind);
    return by_name;
  }();
  return kinds;
}

}  // namespace bodice::cli
