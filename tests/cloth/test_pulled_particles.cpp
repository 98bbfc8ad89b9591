// Particles on the body that constraints pull through it must not push the layers that they meet.
#include <doctest/doctest.h>

#include "layer_fixtures.hpp"
#include "selfcontact/self_contact.hpp"

using namespace bodice;
using namespace bodice_test;

namespace {

/// A sheet on a body, and another one over it, at rest when a substep begins.
struct SheetOnBody {
  static constexpr int kCells = 12;
  static constexpr double kSide_m = 0.12, kBetween_m = 5e-3, kLayerGap_m = 1.5e-3;
  static constexpr float kSubstep_s = 1.0f / 960.0f;

  TriMesh mesh;
  cloth::Particles particles;
  std::vector<std::uint8_t> touching;
  std::vector<float> friction_share;
  cloth::SelfContact self;
  Index pulled = 6 * (kCells + 1) + 6;  ///< in the middle of the lower sheet

  SheetOnBody() {
    for (const double height_m : {0.0, kBetween_m})
      append(surface(kCells, kCells, false,
                     [&](double u, double v) { return Vec3(u * kSide_m, height_m, v * kSide_m); }),
             mesh);
    particles = cloth::make_particles(mesh, 0.1, std::vector<bool>(mesh.positions.size(), false));
    for (std::size_t i = 0; i < particles.count(); ++i)
      particles.point[i] = {particles.x[i], particles.y[i], particles.z[i], particles.inverse_mass[i]};
    touching.assign(particles.count(), 0), friction_share.assign(particles.count(), 1.0f);
    self = cloth::make_self_contact(mesh, particles, kLayerGap_m, kSide_m / kCells);
    cloth::begin_self_contact({}, particles, self);
  }

  /// Pulls the particle up through the upper sheet, as a stretched edge does, and pushes layers apart.
  void pull_up(float by_m) {
    particles.point[pulled].y += by_m;
    cloth::push_apart({},
                      {.length_s = kSubstep_s,
                       .frame_s = 16 * kSubstep_s,
                       .touching = touching,
                       .friction_share = friction_share},
                      self, particles);
  }

  /// How far the upper sheet was moved at most.
  double upper_moved_m() const {
    double most = 0.0;
    for (std::size_t i = particles.count() / 2; i < particles.count(); ++i) {
      const cloth::Point& to = particles.point[i];
      most = std::max(most, std::hypot(double{to.x - particles.x[i]}, double{to.y - particles.y[i]},
                                       double{to.z - particles.z[i]}));
    }
    return most;
  }
};

}  // namespace

TEST_CASE("pulled: a particle that is free pushes the layer through which it is pulled") {
  SheetOnBody sheets;
  sheets.friction_share[sheets.pulled] = 0.0f;
  sheets.pull_up(0.02f);
  CHECK(sheets.upper_moved_m() > 5e-3);
}

TEST_CASE("pulled: so does a particle on the body, unless its edges are stretched") {
  SheetOnBody sheets;
  sheets.touching[sheets.pulled] = 1;
  sheets.pull_up(0.02f);
  CHECK(sheets.upper_moved_m() > 5e-3);
}

TEST_CASE("pulled: a particle on the body with stretched edges pushes no layer, and its pull remains") {
  SheetOnBody sheets;
  sheets.touching[sheets.pulled] = 1, sheets.friction_share[sheets.pulled] = 0.5f;
  sheets.pull_up(0.02f);
  CHECK(sheets.upper_moved_m() == 0.0);
  const cloth::Point& to = sheets.particles.point[sheets.pulled];
  CHECK(double{to.y - sheets.particles.y[sheets.pulled]} == doctest::Approx(0.02));
  CHECK(to.weight == sheets.particles.inverse_mass[sheets.pulled]);
}
