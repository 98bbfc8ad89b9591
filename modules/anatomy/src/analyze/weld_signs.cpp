#include "analyze/weld_signs.hpp"

#include <algorithm>

namespace bodice::inline v0_1::anatomy {
namespace {

bool is_handle(const engine::Warning& w) {
  return w.code == "limbs-fused";
}

bool is_short_path(const engine::Warning& w) {
  return w.code == "hand-fused-to-leg" || w.code == "legs-fused";
}

bool is_other_doubt(const engine::Warning& w) {
  return w.code.ends_with("-uncertain") || w.code.ends_with("-disagrees") || w.code.ends_with("-differ") ||
         w.code == "unusual-body";
}

}  // namespace

bool shows_welds(const Anatomy& found) {
  return limbs_meet(found) || std::ranges::any_of(found.warnings, is_handle);
}

bool is_welded(const engine::Result<Anatomy>& found) {
  return !found || shows_welds(*found);
}

bool arms_differ(const engine::Result<Anatomy>& found) {
  return found &&
         std::ranges::find(found->warnings, "arms-differ", &engine::Warning::code) != found->warnings.end();
}

bool limbs_meet(const Anatomy& found) {
  return short_paths(found) > 0;
}

int short_paths(const Anatomy& found) {
  return static_cast<int>(std::ranges::count_if(found.warnings, is_short_path));
}

int doubts(const Anatomy& anatomy) {
  return doubts_but_handles(anatomy) + static_cast<int>(std::ranges::count_if(anatomy.warnings, is_handle));
}

int doubts_but_handles(const Anatomy& anatomy) {
  return static_cast<int>(std::ranges::count_if(anatomy.warnings, is_other_doubt));
}

}  // namespace bodice::anatomy
