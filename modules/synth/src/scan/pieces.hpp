// A body as the pieces of a game character.
#pragma once

#include <vector>

#include <bodice/synth/body.hpp>
#include <bodice/synth/scan.hpp>

namespace bodice::inline v0_1::synth {

/// Head, trunk, hands, arms, legs and feet as open pieces. kPieces: with gaps of some millimeters; kTucked:
/// each reaches a little into the next; kClothes: skin at head and hands, clothes elsewhere.
std::vector<ScanMesh> cut_to_pieces(ScanKind kind, const Body& body);

}  // namespace bodice::synth
