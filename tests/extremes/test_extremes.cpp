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

TEST_CASE("extremes: point sets") {
  run(extremes::point_rows(), 100);
}
TEST_CASE("extremes: ellipsoids") {
  run(extremes::ellipsoid_rows(), 200);
}
TEST_CASE("extremes: scenes") {
  run(extremes::scene_rows(), 120);
}
TEST_CASE("extremes: meshes") {
  run(extremes::mesh_rows(), 300);
}
TEST_CASE("extremes: bodies") {
  run(extremes::body_rows(), 30);
}
TEST_CASE("extremes: numbers") {
  run(extremes::number_rows(), 80);
}
