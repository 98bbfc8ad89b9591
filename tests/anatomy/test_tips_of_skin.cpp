// Crown and fingertips of a thin copy, beside those of the skin that it was made of.
#include <doctest/doctest.h>

#include <algorithm>

#include <bodice/synth/body.hpp>

#include "analyze/tips_of_skin.hpp"
#include "analyzed.hpp"

using namespace bodice;
using body::LandmarkId;

namespace {

const anatomy::Anatomy& clean_body() {
  static const anatomy::Anatomy found = [] {
    const auto made = synth::make_body({}, {});
    REQUIRE(made.ok());
    return analyzed(made->mesh);
  }();
  return found;
}

}  // namespace

TEST_CASE("a thin copy's doubt about the crown stays unless the skin has the same crown and none") {
  constexpr auto kCrown = static_cast<std::size_t>(LandmarkId::kCrown);
  const anatomy::Anatomy& clean = clean_body();
  anatomy::Anatomy doubted = clean;
  doubted.warnings.push_back({"crown-disagrees", "head", "", ""});
  doubted.landmarks[kCrown].confidence = 0.1;
  const auto doubts = [](const anatomy::Anatomy& found) {
    return std::ranges::count(found.warnings, "crown-disagrees", &engine::Warning::code);
  };
  anatomy::Anatomy apart = doubted;
  anatomy::take_tips(clean, apart);
  CHECK(doubts(apart) == 0);
  CHECK(apart.landmarks[kCrown].confidence == clean.landmarks[kCrown].confidence);
  apart = doubted;
  anatomy::take_tips(doubted, apart);
  CHECK(doubts(apart) == 1);
  apart = doubted;
  apart.landmarks[kCrown].position += 0.03 * apart.stature_m * apart.up;
  anatomy::take_tips(clean, apart);
  CHECK(doubts(apart) == 1);
  CHECK(apart.landmarks[kCrown].confidence == 0.1);
}

TEST_CASE("fingers that a thin copy has lost end where those of the skin do, unless limbs meet there") {
  struct Case {
    double lost;
    bool welded, taken;
  };
  for (const Case& c : {Case{0.04, false, true}, Case{0.04, true, false}, Case{0.08, false, false}})
    for (const LandmarkId id : {LandmarkId::kFingertipL, LandmarkId::kFingertipR}) {
      const auto tip = static_cast<std::size_t>(id);
      anatomy::Anatomy as_is = clean_body(), apart = as_is;
      if (c.welded) as_is.warnings.push_back({"hand-fused-to-leg", "forearm_l", "", ""});
      apart.landmarks[tip].position += c.lost * apart.stature_m * apart.up;
      apart.landmarks[tip].vertex = 0;
      apart.warnings.push_back(
          {"fingertip-disagrees", id == LandmarkId::kFingertipL ? "forearm_l" : "forearm_r", "", ""});
      const geometry::Vec3 short_tip = apart.landmarks[tip].position;
      anatomy::take_tips(as_is, apart);
      CHECK(apart.landmarks[tip].position == (c.taken ? as_is.landmarks[tip].position : short_tip));
      CHECK(apart.landmarks[tip].vertex == (c.taken ? as_is.landmarks[tip].vertex : 0u));
      CHECK(std::ranges::count(apart.warnings, "fingertip-disagrees", &engine::Warning::code) == 1);
    }
}
