#include <doctest/doctest.h>

#include "rows.hpp"

namespace {

void run(const std::vector<extremes::Row>& rows, std::size_t least) {
  CHECK(rows.size() >= least);
  for (const extremes::Row& row : rows) {
    const std::string wrong = row.check();
    CHECK_MESSAGE(wrong.empty(), row.algorithm, " | ", row.input, " | ", wrong);
  }
}

}  // namespace

TEST_CASE("extremes: enclosing ellipsoids and clusters of every hostile point set") {
  run(extremes::point_rows(), 100);
}
TEST_CASE("extremes: distances and responses of every hostile ellipsoid") {
  run(extremes::ellipsoid_rows(), 200);
}
TEST_CASE("extremes: queries of unions of ellipsoids that no fit makes") {
  run(extremes::scene_rows(), 120);
}
TEST_CASE("extremes: every public function of a mesh, on every hostile mesh") {
  run(extremes::mesh_rows(), 300);
}
TEST_CASE("extremes: a body at any scale and offset gives the same landmarks and fit") {
  run(extremes::body_rows(), 30);
}
TEST_CASE("extremes: absurd numbers in options are refused or harmless") {
  run(extremes::number_rows(), 80);
}
TEST_CASE("extremes: rigs, clips and skinning matrices of any kind are finite or refused in a sentence") {
  run(extremes::rig_rows(), 70);
}
TEST_CASE("extremes: joint matrices of any kind pose a proxy within bounds, or are refused by name") {
  run(extremes::pose_rows(), 45);
}
