#include <doctest/doctest.h>

#include <bodice_test/shapes.hpp>

#include "body/scan_doubts.hpp"

using namespace bodice;

namespace {

constexpr std::size_t kPerineum = static_cast<std::size_t>(body::LandmarkId::kPerineum);
constexpr std::size_t kFingertipL = static_cast<std::size_t>(body::LandmarkId::kFingertipL);

/// A sheet as the skin, with the perineum in its middle and the other landmarks at a border. At first no
/// vertex is made up.
struct Closed {
  io::ImportedMesh mesh;
  anatomy::Anatomy anatomy;
  std::vector<engine::Warning> warnings;

  Closed() {
    mesh.skin = bodice_test::sheet(0.4, 0.4, 40, 40);
    mesh.made_up.assign(mesh.skin.positions.size(), 0);
    anatomy.stature_m = 2.0;
    for (std::size_t i = 0; i < body::kLandmarkCount; ++i)
      anatomy.landmarks.push_back(
          {static_cast<body::LandmarkId>(i), geometry::Vec3(-0.15, 0.0, 0.0), 0, 1.0});
    anatomy.landmarks[kPerineum].position.setZero();
  }

  /// Marks the skin beyond x = from_m as made up; the perineum is at x = 0.
  void make_up(double from_m) {
    for (std::size_t v = 0; v < mesh.made_up.size(); ++v)
      mesh.made_up[v] = mesh.skin.positions[v].x() > from_m;
  }
  std::string codes() {
    warnings.clear();
    tryon::warn_of_scan(mesh, anatomy, warnings);
    std::string all;
    for (const engine::Warning& warning : warnings) all += warning.code + " ";
    return all;
  }
};

}  // namespace

TEST_CASE("a landmark gets a warning where much of its skin is made up; one of low confidence needs less") {
  Closed closed;
  CHECK(closed.codes().empty());
  closed.make_up(0.001);  // nearly a half of the disk of 60 mm around the perineum
  CHECK(closed.codes() == "landmarks-made-up ");
  CHECK(closed.warnings[0].note);
  CHECK(closed.warnings[0].message.find("perineum") != std::string::npos);
  CHECK(closed.warnings[0].message.find("knee") == std::string::npos);
  closed.make_up(0.024);  // a quarter of it
  CHECK(closed.codes().empty());
  closed.anatomy.landmarks[kPerineum].confidence = 0.5;
  CHECK(closed.codes() == "landmarks-made-up ");
}

TEST_CASE("the warning is more than a note if most skin is made up, or if other landmarks are in doubt") {
  Closed closed;
  closed.make_up(-0.03);  // three quarters of the disk
  REQUIRE(closed.codes() == "landmarks-made-up ");
  CHECK_FALSE(closed.warnings[0].note);
  closed.make_up(0.001);
  closed.anatomy.warnings = {{"perineum-uncertain", "", "", ""}};
  REQUIRE(closed.codes() == "landmarks-made-up ");
  CHECK_FALSE(closed.warnings[0].note);
}

TEST_CASE("a hand that is shorter than the other one gives a warning where holes were closed") {
  Closed closed;
  closed.anatomy.landmarks[kFingertipL].position.x() += 0.05;
  CHECK(closed.codes().empty());
  closed.anatomy.landmarks[kFingertipL].position.x() += 0.03;
  REQUIRE(closed.codes() == "limbs-unequal ");
  CHECK(closed.warnings[0].message == "The right forearm with its hand is 80 mm shorter than the other one.");
  closed.anatomy.landmarks[kFingertipL].confidence = 0.0;  // not found
  CHECK(closed.codes().empty());
  closed.anatomy.landmarks[kFingertipL].confidence = 1.0;
  closed.mesh.made_up.clear();  // the file's skin was closed already
  CHECK(closed.codes().empty());
  closed.mesh.made_up.assign(closed.mesh.skin.positions.size(), 0);
  closed.anatomy.landmarks.clear();  // a thing that is no person
  CHECK(closed.codes().empty());
}

TEST_CASE("armpits and crotch that together look unusual give a warning, in scans only") {
  Closed scan;
  scan.mesh.made_up.clear();
  for (const body::LandmarkId id : {body::LandmarkId::kArmpitL, body::LandmarkId::kArmpitR})
    scan.anatomy.landmarks[static_cast<std::size_t>(id)].confidence = 0.7;
  scan.anatomy.landmarks[kPerineum].confidence = 0.7;
  CHECK(scan.codes().empty());
  scan.mesh.noise_m = 0.001;
  CHECK(scan.codes() == "folds-uncertain ");
  scan.anatomy.landmarks[kPerineum].confidence = 0.9;
  CHECK(scan.codes().empty());
  scan.anatomy.landmarks[kPerineum].confidence = 0.7;
  scan.anatomy.warnings = {{"perineum-uncertain", "", "", ""}};  // it is in doubt already
  CHECK(scan.codes().empty());
}
