// The folds between limbs, by name, and what is done where one of them is in doubt.
#pragma once

#include <array>
#include <string>

#include <bodice/anatomy/anatomy.hpp>

namespace bodice::inline v0_1::anatomy {

/// A fold between limbs.
struct NamedFold {
  body::LandmarkId id;
  body::Part part;   ///< the limb that begins there
  const char* code;  ///< code of the warning that doubts it
  const char* name;  ///< for the middle of a sentence
};

inline constexpr std::array<NamedFold, 3> kNamedFolds = {
    {{body::LandmarkId::kArmpitL, body::Part::kUpperArmL, "armpit-uncertain", "the left armpit"},
     {body::LandmarkId::kArmpitR, body::Part::kUpperArmR, "armpit-uncertain", "the right armpit"},
     {body::LandmarkId::kPerineum, body::Part::kThighL, "perineum-uncertain", "the crotch"}}};

/// Whether a warning doubts the fold.
bool in_doubt(const Anatomy& anatomy, const NamedFold& fold);

/// Lowers the confidence of a fold below that of landmarks which are named in a warning, and warns of it.
/// `lies` ends the sentence that begins with its name; `shown_by` is the pose that the remedy names.
void doubt_fold(const NamedFold& fold, const std::string& lies, const std::string& shown_by,
                Anatomy& anatomy);

}  // namespace bodice::anatomy
