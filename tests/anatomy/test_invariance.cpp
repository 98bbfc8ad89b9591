#include <doctest/doctest.h>

#include <bodice/engine/random.hpp>
#include <bodice/geometry/mesh_repair.hpp>
#include <bodice_test/data.hpp>
#include <bodice_test/read_mesh.hpp>

#include "analyzed.hpp"
#include "made.hpp"
#include "remesh.hpp"

using namespace bodice;
using body::LandmarkId;
using geometry::TriMesh;
using geometry::Vec3;

namespace {

/// What no change of the mesh that leaves the body alone may move a landmark by, of the stature.
constexpr double kSame = 0.01;
/// The same for landmarks of tailors, which no correction draws to others: coarse meshes change the distances
/// that they are found by.
constexpr double kSameForTailors = 0.015;

double same(LandmarkId id) {
  return id > LandmarkId::kToeR ? kSameForTailors : kSame;
}

template <class Back>
void check_same(const anatomy::Anatomy& reference, const anatomy::Anatomy& found, double scale, Back back) {
  CHECK(found.stature_m / scale == doctest::Approx(reference.stature_m).epsilon(kSame));
  for (int i = 0; i < body::kLandmarkCount; ++i) {
    CAPTURE(std::string(body::kLandmarkNames[i]));
    CHECK((reference.landmarks[i].position - back(found.landmarks[i].position)).norm() <
          same(static_cast<LandmarkId>(i)) * reference.stature_m);
  }
}

struct Motion {
  Eigen::Quaterniond turn;
  double scale;
  Vec3 shift;
  Vec3 operator()(const Vec3& p) const { return scale * (turn * p) + shift; }
  Vec3 back(const Vec3& p) const { return turn.conjugate() * (p - shift) / scale; }
};

std::vector<geometry::Index> shuffled(std::size_t count, engine::Random& random) {
  std::vector<geometry::Index> order(count);
  for (std::size_t i = 0; i < count; ++i) order[i] = static_cast<geometry::Index>(i);
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  return order;
}

/// Turned, moved, scaled and with its vertices in another order, the mesh must give the same landmarks and,
/// but for vertices on borders, the same parts.
void check_moved(const TriMesh& mesh, std::initializer_list<double> scales) {
  const anatomy::Anatomy reference = analyzed(mesh);
  engine::Random random(11);
  for (const double scale : scales) {
    CAPTURE(scale);
    const Motion move{
        Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal()).normalized(),
        scale, 100.0 * scale * Vec3(1, -2, 3)};
    const auto order = shuffled(mesh.positions.size(), random);
    TriMesh moved = mesh;
    for (std::size_t v = 0; v < order.size(); ++v) moved.positions[order[v]] = move(mesh.positions[v]);
    for (auto& t : moved.triangles) t = {order[t[0]], order[t[1]], order[t[2]]};
    const anatomy::Anatomy found = analyzed(moved);
    check_same(reference, found, scale, [&](const Vec3& p) { return move.back(p); });
    std::size_t differ = 0;
    for (std::size_t v = 0; v < order.size(); ++v) differ += found.part[order[v]] != reference.part[v];
    CHECK(differ < order.size() / 200);
  }
}

void check_remeshed(const TriMesh& mesh) {
  const anatomy::Anatomy reference = analyzed(mesh);
  const auto unmoved = [](const Vec3& p) { return p; };
  const TriMesh fine = remesh::refined(remesh::refined(mesh));
  CHECK(fine.positions.size() > 190000);
  check_same(reference, analyzed(fine), 1.0, unmoved);
  const TriMesh coarse = remesh::decimated(mesh, 1500);
  CHECK(coarse.positions.size() <= 1500);
  check_same(reference, analyzed(coarse), 1.0, unmoved);
}

TriMesh repaired(const std::filesystem::path& file) {
  auto result = geometry::repair({}, bodice_test::read_mesh(file));
  REQUIRE(result.ok());
  return std::move(result->mesh);
}

}  // namespace

TEST_CASE("rotation, position, scale and the order of vertices do not change the answer") {
  check_moved(made::random_body(3).mesh, {1e-6, 1e-3, 1.0, 1e3, 1e6});
  for (const std::uint64_t seed : {1, 4, 6}) {
    CAPTURE(seed);
    check_moved(made::random_body(seed).mesh, {1e-3, 1e3});
  }
}

TEST_CASE("finer and coarser meshes of one body give the same landmarks") {
  synth::BodyOptions options;
  options.vertices = 12500;
  const auto body = synth::make_body({}, options);
  REQUIRE(body.ok());
  check_remeshed(body->mesh);
}

TEST_CASE("real bodies, turned, scaled and permuted, give the same answer") {
  for (const char* name :
       {"bodies/f_avg_rest.obj", "bodies/m_old_heavy_sit01.obj", "bodies/f_tall_muscle_standing01.obj"}) {
    const auto file = bodice_test::data_file(name);
    if (!file) continue;
    CAPTURE(name);
    check_moved(repaired(*file), {1e-3, 1e3});
  }
}

TEST_CASE("a real body with 1,500 and with 200,000 vertices has the same landmarks") {
  if (const auto file = bodice_test::data_file("bodies/m_avg_rest.obj")) check_remeshed(repaired(*file));
}

TEST_CASE("damage that leaves the body whole changes nothing; what welds limbs is refused by name") {
  const auto whole = bodice_test::data_file("awkward/f_avg_inverted.obj");
  if (!whole) return;
  const anatomy::Anatomy reference = analyzed(repaired(*whole));
  for (const char* name : {"awkward/f_avg_mixed_winding.obj", "awkward/f_avg_nonmanifold_degenerate.obj",
                           "awkward/f_avg_soup.stl", "awkward/f_avg_holes.obj"}) {
    CAPTURE(name);
    const auto file = bodice_test::data_file(name);
    REQUIRE(file);
    const anatomy::Anatomy found = analyzed(repaired(*file));
    const bool holes = std::any_of(found.warnings.begin(), found.warnings.end(),
                                   [](const engine::Warning& w) { return w.code == "holes"; });
    for (int i = 0; i < body::kLandmarkCount; ++i)
      CHECK((reference.landmarks[i].position - found.landmarks[i].position).norm() <
            (holes ? 2.5 : 1.0) * same(static_cast<LandmarkId>(i)) * reference.stature_m);
  }
}

TEST_CASE("a scan with hands grown to the thighs is cut apart, and has the landmarks of the clean body") {
  const auto fused = bodice_test::data_file("awkward/m_avg_armsdown_fused.obj"),
             clean = bodice_test::data_file("bodies/m_avg_armsdown.obj");
  if (!fused || !clean) return;
  const anatomy::Anatomy reference = analyzed(repaired(*clean)), found = analyzed(repaired(*fused));
  CHECK(std::any_of(found.warnings.begin(), found.warnings.end(),
                    [](const engine::Warning& w) { return w.code == "limbs-cut"; }));
  CHECK(found.stature_m == doctest::Approx(reference.stature_m).epsilon(0.01));
  for (int i = 0; i <= static_cast<int>(LandmarkId::kToeR); ++i) {
    CAPTURE(i);
    CHECK((reference.landmarks[i].position - found.landmarks[i].position).norm() <
          0.045 * reference.stature_m);
  }
}
