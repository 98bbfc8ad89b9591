// Hair that is taken for skin: what is tied up, and what hangs down.
#include <doctest/doctest.h>

#include <algorithm>

#include <bodice/synth/scan.hpp>
#include <bodice_test/share_near.hpp>

#include "analyze/tips_of_skin.hpp"
#include "analyzed.hpp"
#include "made.hpp"

using namespace bodice;
using geometry::TriMesh;
using geometry::Vec3;

namespace {

constexpr std::size_t kMainLandmarks = 13;

bool names_bun(const anatomy::Anatomy& found) {
  return std::ranges::any_of(found.warnings, [](const engine::Warning& w) {
    return w.code == "crown-disagrees" && w.message.find("stands off the head") != std::string::npos;
  });
}

bool names_nape(const anatomy::Anatomy& found) {
  return std::ranges::any_of(found.warnings,
                             [](const engine::Warning& w) { return w.code == "nape-covered"; });
}

}  // namespace

TEST_CASE("a bun of hair is named and moves neither the crown nor the stature, wherever it is tied") {
  constexpr auto kCrown = static_cast<std::size_t>(body::LandmarkId::kCrown);
  for (const std::uint64_t seed : {9600, 9601, 9602, 9603, 9605, 40007, 40105, 40107, 40108, 40109}) {
    CAPTURE(seed);
    const auto scan = synth::make_scan({}, synth::ScanKind::kBunAndHem, seed);
    REQUIRE(scan.ok());
    const synth::ScanPerson& truth = scan->persons[0];
    const anatomy::Anatomy found = analyzed(made::skin_of(*scan));
    CHECK(found.stature_m == doctest::Approx(truth.stature_m).epsilon(0.02));
    const Vec3 off = found.landmarks[kCrown].position - truth.landmarks[kCrown].position;
    CHECK(off.norm() < 0.03 * truth.stature_m);
    CHECK(names_bun(found));
    CHECK(!names_bun(analyzed(truth.body)));
  }
}

TEST_CASE("hair that stands off the neck is named and moves no landmark, a bare neck is not") {
  int thick = 0;
  for (const std::uint64_t seed : {41000, 41003, 41007, 41009}) {
    CAPTURE(seed);
    const auto scan = synth::make_scan({}, synth::ScanKind::kLongHair, seed);
    REQUIRE(scan.ok());
    const synth::ScanPerson& truth = scan->persons[0];
    const TriMesh skin = made::skin_of(*scan);
    const anatomy::Anatomy found = analyzed(skin), bare = analyzed(truth.body);
    CHECK(!names_nape(bare));
    if (bodice_test::share_near(skin, truth.body, 0.03) < 0.98) {
      ++thick;
      CHECK(names_nape(found));
    }
    for (std::size_t i = 0; i < kMainLandmarks; ++i) {
      const double off = (found.landmarks[i].position - truth.landmarks[i].position).norm();
      CHECK_MESSAGE(off < 0.045 * truth.stature_m, body::kLandmarkNames[i]);
    }
  }
  CHECK(thick == 3);
}

TEST_CASE("a covered nape of a thin copy counts only where the skin shows it") {
  anatomy::Anatomy without, with;
  without.landmarks.resize(kMainLandmarks);
  with = without;
  with.warnings.push_back({"nape-covered", "head", "", ""});
  anatomy::Anatomy on_copy = with;
  anatomy::take_tips(with, on_copy);
  CHECK(names_nape(on_copy));
  anatomy::take_tips(without, on_copy);
  CHECK(!names_nape(on_copy));
}
