#include "landmarks/landmark_table.hpp"

namespace bodice::inline v0_1::anatomy {

// Each is the one function that its file exports.
LandmarkKind crown(), neck(), fingertip(), elbow(), knee(), perineum(), armpit(), toe(), neck_front(),
    neck_back(), neck_side(), shoulder(), bust(), underbust(), waist(), hip(), wrist(), ankle();

std::span<const LandmarkKind> landmark_kinds() {
  static const std::array kinds{crown(),  neck(),      fingertip(),  elbow(),     knee(),      perineum(),
                                armpit(), toe(),       neck_front(), neck_back(), neck_side(), shoulder(),
                                bust(),   underbust(), waist(),      hip(),       wrist(),     ankle()};
  return kinds;
}

}  // namespace bodice::anatomy
