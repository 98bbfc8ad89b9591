#include "check/landmark_warnings.hpp"

#include "landmarks/landmark_table.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

/// "armpit" for the left and for the right armpit.
std::string name_without_side(const LandmarkKind& kind) {
  const std::string_view name = body::name(kind.id);
  return std::string(kind.paired ? name.substr(0, name.size() - 2) : name);
}

std::string name_with_side(const LandmarkKind& kind, int side) {
  const std::string name = name_without_side(kind);
  if (!kind.paired) return name;
  return (side == 0 ? "left " : "right ") + name;
}

std::string part_named(const LandmarkKind& kind, int side) {
  return std::string(body::name(side == 0 ? kind.part : body::mirrored(kind.part)));
}

}  // namespace

void warn_of_landmarks(const CheckedLandmarks& landmarks, std::vector<engine::Warning>& warnings) {
  for_each_landmark([&](const LandmarkKind& kind, int side) {
    const LandmarkId id = body::of_side(kind.id, side);
    if (kind.warn_uncertain && landmarks.marks[id].mark.confidence < kUncertain)
      warnings.push_back({name_without_side(kind) + "-uncertain", part_named(kind, side),
                          "The " + name_with_side(kind, side) + " could not be located with confidence.",
                          "Check this border in the result."});
    for (std::size_t c = 0; c < kind.checks.size(); ++c) {
      const CrossCheck& check = kind.checks[c];
      if (check.warning && landmarks.differences[static_cast<std::size_t>(id)][c] > check.most)
        warnings.push_back({name_without_side(kind) + "-disagrees", part_named(kind, side), check.warning,
                            "Check this border in the result; welded or touching parts often cause it."});
    }
  });
}

}  // namespace bodice::anatomy
