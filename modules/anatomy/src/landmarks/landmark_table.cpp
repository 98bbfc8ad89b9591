#include "landmarks/landmark_table.hpp"

namespace bodice::anatomy {

// Each is the one function that its file exports.
LandmarkKind crown(), neck(), fingertip(), elbow(), knee(), perineum(), armpit(), toe();

std::span<const LandmarkKind> landmark_kinds() {
  static const std::array kinds{crown(), neck(), fingertip(), elbow(), knee(), perineum(), armpit(), toe()};
  return kinds;
}

}  // namespace bodice::anatomy
