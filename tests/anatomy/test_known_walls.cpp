// Limbs that are known roughly are parted where the body is thinnest between them, on shapes with known
// necks.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "walls/known_walls.hpp"

using namespace bodice;
using body::LandmarkId;
using geometry::Vec3;

namespace {

constexpr double kCell_m = 0.01, kCrotch_m = 0.8;

/// Depths of a trunk on two legs that overlap below it, all upright cylinders around the z axis of their x.
geometry::FieldGrid legs_and_trunk() {
  geometry::FieldGrid grid;
  grid.cell_m = kCell_m;
  grid.low = {-0.4, 0.0, -0.2};
  grid.nodes = {80, 174, 40};
  grid.value.assign(grid.nodes[0] * grid.nodes[1] * grid.nodes[2], -1.0F);
  const auto add = [&](double x, double radius, double from, double to) {
    for (std::size_t i = 0; i < grid.value.size(); ++i) {
      const Vec3 at =
          grid.low + kCell_m * Vec3(static_cast<double>(i % 80), static_cast<double>(i / 80 % 174),
                                    static_cast<double>(i / 80 / 174));
      if (at.y() < from || at.y() > to) continue;
      grid.value[i] = std::max(grid.value[i], static_cast<float>(radius - std::hypot(at.x() - x, at.z())));
    }
  };
  add(-0.07, 0.08, 0.03, 0.9), add(0.07, 0.08, 0.03, 0.9), add(0.0, 0.15, 0.9, 1.68);
  return grid;
}

anatomy::Anatomy landmarks() {
  anatomy::Anatomy found;
  found.stature_m = 1.7;
  found.landmarks.resize(body::kLandmarkCount);
  const auto put = [&](LandmarkId id, double x, double y) {
    for (int side = 0; side < 2; ++side)
      found.landmarks[static_cast<std::size_t>(body::of_side(id, side))].position = {side ? -x : x, y, 0.0};
  };
  put(LandmarkId::kKneeL, 0.07, 0.45), put(LandmarkId::kAnkleL, 0.07, 0.1);
  put(LandmarkId::kArmpitL, 0.15, 1.3), put(LandmarkId::kShoulderL, 0.2, 1.4);
  put(LandmarkId::kElbowL, 0.3, 1.1), put(LandmarkId::kWristL, 0.3, 0.8);
  found.landmarks[static_cast<std::size_t>(LandmarkId::kNeck)].position = {0.0, 1.5, 0.0};
  found.landmarks[static_cast<std::size_t>(LandmarkId::kPerineum)].position = {0.0, 0.7, 0.0};
  return found;
}

}  // namespace

TEST_CASE("legs that overlap are parted in the middle up to the fold, and nothing else is") {
  const geometry::FieldGrid grid = legs_and_trunk();
  const std::vector<char> wall = anatomy::known_walls(
      grid, landmarks(), {{LandmarkId::kPerineum, {0.0, kCrotch_m, 0.0}, Vec3::UnitY()}});
  std::size_t parted = 0;
  for (std::size_t y = 5; y < 170; ++y) {
    const bool below = static_cast<double>(y) * kCell_m < kCrotch_m - 1e-9;
    bool walled = false;
    for (std::size_t x = 0; x < 80; ++x)
      for (std::size_t z = 0; z < 40; ++z) {
        if (!wall[grid.index(x, y, z)]) continue;
        CHECK(below);
        CHECK(std::abs(static_cast<double>(x) - 40.0) < 1.5);
        walled = true;
      }
    parted += walled;
  }
  CHECK(parted == 75);  // slices from 5 to 79
}

TEST_CASE("legs are parted in the middle, also where one of them runs into a bulge before both") {
  geometry::FieldGrid grid = legs_and_trunk();
  for (std::size_t i = 0; i < grid.value.size(); ++i) {
    const Vec3 at = grid.low + kCell_m * Vec3(static_cast<double>(i % 80), static_cast<double>(i / 80 % 174),
                                              static_cast<double>(i / 80 / 174));
    const double bulge = 0.11 - (at - Vec3(0.03, 0.6, 0.05)).norm();
    grid.value[i] = std::max(grid.value[i], static_cast<float>(bulge));
  }
  const std::vector<char> wall = anatomy::known_walls(
      grid, landmarks(), {{LandmarkId::kPerineum, {0.0, kCrotch_m, 0.0}, Vec3::UnitY()}});
  CHECK(std::ranges::any_of(wall, [](char w) { return w != 0; }));
  for (std::size_t i = 0; i < wall.size(); ++i)
    if (wall[i]) CHECK(std::abs(static_cast<double>(i % 80) - 40.0) < 1.5);
}

TEST_CASE("below the crotch of a body that strides there is no trunk that legs could not be parted from") {
  geometry::FieldGrid grid = legs_and_trunk();
  for (std::size_t i = 0; i < grid.value.size(); ++i) {  // what has grown together is as deep as the trunk
    const Vec3 at = grid.low + kCell_m * Vec3(static_cast<double>(i % 80), static_cast<double>(i / 80 % 174),
                                              static_cast<double>(i / 80 / 174));
    const double web = 0.09 - std::hypot(at.x(), at.z());
    if (at.y() > 0.6 && at.y() < 0.95) grid.value[i] = std::max(grid.value[i], static_cast<float>(web));
  }
  anatomy::Anatomy found = landmarks();
  for (int side = 0; side < 2; ++side)
    found.landmarks[static_cast<std::size_t>(body::of_side(LandmarkId::kKneeL, side))].position.z() =
        side == 0 ? 0.24 : -0.24;
  found.up = Vec3::UnitY();
  const std::vector<char> wall =
      anatomy::known_walls(grid, found, {{LandmarkId::kPerineum, {0.0, kCrotch_m, 0.0}, Vec3::UnitY()}});
  for (std::size_t y = 66; y < 80; ++y) {
    int walled = 0;
    for (std::size_t x = 38; x < 43; ++x) walled += wall[grid.index(x, y, 20)];
    CHECK(walled > 0);
  }
}

TEST_CASE("without a fold there is no wall") {
  const std::vector<char> wall = anatomy::known_walls(legs_and_trunk(), landmarks(), {});
  CHECK(std::ranges::none_of(wall, [](char w) { return w != 0; }));
}
