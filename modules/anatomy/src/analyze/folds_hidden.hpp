// The folds that webs between limbs hide, for a sentence.
#pragma once

#include <string>

#include <bodice/anatomy/anatomy.hpp>

namespace bodice::inline v0_1::anatomy {

/// The folds that lie higher where limbs came apart than on the skin as it is, joined to a clause: "the left
/// armpit, the crotch". Empty if there are none.
std::string hidden_folds(const Anatomy& as_is, const Anatomy& apart);

}  // namespace bodice::anatomy
