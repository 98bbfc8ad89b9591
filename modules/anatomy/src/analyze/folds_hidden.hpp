// The names of folds that webs between limbs hide, for a message.
#pragma once

#include <string>

#include <bodice/anatomy/anatomy.hpp>

namespace bodice::inline v0_1::anatomy {

/// The folds that lie higher in `apart`, after limbs were cut apart, than in `as_is`, as a list: "the left
/// armpit, the crotch". Empty if there are none.
std::string hidden_folds(const Anatomy& as_is, const Anatomy& apart);

}  // namespace bodice::anatomy
