#pragma once

#include <utility>

#include <doctest/doctest.h>

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/body/proportions.hpp>

/// The anatomy of a skin that must be a person's, by the profile of the survey that the program uses.
inline bodice::anatomy::Anatomy analyzed(const bodice::geometry::TriMesh& skin) {
  auto found = bodice::anatomy::analyze({}, skin, {*bodice::body::find_profile("ansur2")});
  REQUIRE_MESSAGE(found.ok(), found.error().sentence());
  return std::move(found).value();
}
