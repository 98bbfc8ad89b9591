// The exact distance to a mesh through the C interface; the formula of a box is the oracle.
#include <cstring>
#include <limits>

#include <bodice_test/shapes.hpp>

#include "capi/scene.hpp"

using namespace capi_test;

namespace {

const bodice_test::Vec3 kHalf(0.2, 0.3, 0.1), kCenter(1.0, 1.5, -2.0);

/// The signed distance to the box.
double to_box(const bodice_test::Vec3& p) {
  const bodice_test::Vec3 q = (p - kCenter).cwiseAbs() - kHalf;
  return q.cwiseMax(0.0).norm() + std::min(0.0, q.maxCoeff());
}

/// The box as the host has it: vertices of floats or doubles, indices of any size.
template <class Scalar, class Index>
struct HostBox {
  std::vector<Scalar> xyz;
  std::vector<Index> index;
  bodice_mesh mesh = bodice_default_mesh();

  HostBox() {
    const auto box = bodice_test::box(kHalf, 3, kCenter);
    for (const auto& p : box.positions)
      for (int axis = 0; axis < 3; ++axis) xyz.push_back(static_cast<Scalar>(p[axis]));
    for (const auto& triangle : box.triangles)
      for (const auto v : triangle) index.push_back(static_cast<Index>(v));
    mesh.position = bodice::detail::vectors(xyz.data(), 0);
    mesh.vertices = xyz.size() / 3;
    mesh.index = index.data();
    mesh.triangles = index.size() / 3;
    mesh.index_bytes = sizeof(Index);
  }
};

using Exact = bodice::detail::Handle<bodice_exact, bodice_exact_destroy>;

template <class Box>
void check_distances(const bodice::Context& context, const Box& box, double tolerance_m) {
  bodice_exact* made = nullptr;
  REQUIRE_MESSAGE(bodice_exact_create(context.get(), &box.mesh, &made) == BODICE_OK, bodice_last_error());
  const Exact exact(made);
  bodice::engine::Random random(6);
  std::vector<double> world;
  for (int i = 0; i < 500; ++i) {
    const bodice_test::Vec3 p = kCenter + bodice_test::random_vector(random, 0.5);
    world.insert(world.end(), {p.x(), p.y(), p.z()});
  }
  world[3 * 400] = std::numeric_limits<double>::quiet_NaN();
  bodice::Particles particles(500);
  particles.position(world.data());
  std::vector<double> distance(500), point(1500);
  std::vector<bodice_contact> contact(500);
  std::vector<std::uint32_t> triangle(500);
  bodice_contacts contacts = bodice_default_contacts();
  contacts.distance = {distance.data(), 0, BODICE_DOUBLE, 0};
  contacts.point = bodice::detail::vectors(point.data(), 0);
  contacts.contact = contact.data();
  contacts.ellipsoid = triangle.data();
  REQUIRE(bodice_exact_query(exact.get(), &particles, &contacts) == BODICE_OK);
  double worst = 0.0;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < 500; ++i) {
    if (i == 400) continue;
    const bodice_test::Vec3 p(world[3 * i], world[3 * i + 1], world[3 * i + 2]);
    const bodice_test::Vec3 on(point[3 * i], point[3 * i + 1], point[3 * i + 2]);
    worst =
        std::max({worst, std::abs(distance[i] - to_box(p)), std::abs((p - on).norm() - std::abs(to_box(p)))});
    wrong += contact[i].distance != static_cast<float>(distance[i]) || triangle[i] >= box.mesh.triangles;
  }
  CHECK(worst < tolerance_m);
  CHECK(wrong == 0);
  CHECK(distance[400] == std::numeric_limits<double>::infinity());
  CHECK(triangle[400] == BODICE_NO_ELLIPSOID);
}

/// Rounding of doubles; and of the box's vertices to floats: half a unit in the last digit at 2 m, along
/// three axes.
constexpr double kDouble_m = 1e-12, kFloat_m = 2.1e-7;

}  // namespace

TEST_CASE("capi: the exact distance to a box is that of the formula, for every type of its arrays") {
  for (const int workers : {1, 3}) {
    const bodice::Context context = make_context(workers);
    check_distances(context, HostBox<double, std::uint32_t>(), kDouble_m);
    check_distances(context, HostBox<float, std::uint16_t>(), kFloat_m);
    check_distances(context, HostBox<double, std::int64_t>(), kDouble_m);
  }
}

TEST_CASE("capi: a mesh that cannot be is refused, with the vertex or the triangle at fault") {
  const bodice::Context context = make_context();
  const auto refused = [&](auto change, const char* words) {
    HostBox<double, std::uint32_t> box;
    change(box);
    bodice_exact* made = nullptr;
    CHECK(bodice_exact_create(context.get(), &box.mesh, &made) == BODICE_INVALID_ARGUMENT);
    CHECK(made == nullptr);
    CAPTURE(bodice_last_error());
    CHECK(std::string(bodice_last_error()).find(words) != std::string::npos);
  };
  refused([](auto& box) { box.index[7] = 9999; }, "Triangle 2 refers to vertex 9999");
  refused([](auto& box) { box.xyz[5] = std::numeric_limits<double>::infinity(); }, "Vertex 1 of the mesh");
  refused([](auto& box) { box.mesh.triangles = 0; }, "no triangles");
  refused([](auto& box) { box.mesh.index = nullptr; }, "no triangles");
  refused([](auto& box) { box.mesh.position.x = nullptr; }, "position has no arrays");
  refused([](auto& box) { box.mesh.index_bytes = 3; }, "index_bytes is 3");
  refused([](auto& box) { box.mesh.vertices = std::size_t{1} << 31; }, "BODICE_MAX_PARTICLES");
  bodice_mesh zero;
  std::memset(&zero, 0, sizeof zero);
  bodice_exact* made = nullptr;
  CHECK(bodice_exact_create(context.get(), &zero, &made) == BODICE_NOT_INITIALIZED);
  CHECK(bodice_exact_create(nullptr, &zero, &made) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_exact_query(nullptr, nullptr, nullptr) == BODICE_INVALID_ARGUMENT);
  bodice_exact_destroy(nullptr);
}
