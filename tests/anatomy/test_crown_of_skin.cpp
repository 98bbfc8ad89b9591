// The doubts of a thin copy about a crown, beside those of the skin that it was made of.
#include <doctest/doctest.h>

#include <algorithm>

#include <bodice/synth/body.hpp>

#include "analyze/crown_of_skin.hpp"
#include "analyzed.hpp"

using namespace bodice;
using body::LandmarkId;

TEST_CASE("a thin copy's doubt about the crown stays unless the skin has the same crown and none") {
  constexpr auto kCrown = static_cast<std::size_t>(LandmarkId::kCrown);
  const auto made = synth::make_body({}, {});
  REQUIRE(made.ok());
  const anatomy::Anatomy clean = analyzed(made->mesh);
  anatomy::Anatomy doubted = clean;
  doubted.warnings.push_back({"crown-disagrees", "head", "", ""});
  doubted.landmarks[kCrown].confidence = 0.1;
  const auto doubts = [](const anatomy::Anatomy& found) {
    return std::ranges::count(found.warnings, "crown-disagrees", &engine::Warning::code);
  };
  anatomy::Anatomy apart = doubted;
  anatomy::drop_crown_doubts(clean, apart);
  CHECK(doubts(apart) == 0);
  CHECK(apart.landmarks[kCrown].confidence == clean.landmarks[kCrown].confidence);
  apart = doubted;
  anatomy::drop_crown_doubts(doubted, apart);
  CHECK(doubts(apart) == 1);
  apart = doubted;
  apart.landmarks[kCrown].position += 0.03 * apart.stature_m * apart.up;
  anatomy::drop_crown_doubts(clean, apart);
  CHECK(doubts(apart) == 1);
  CHECK(apart.landmarks[kCrown].confidence == 0.1);
}
