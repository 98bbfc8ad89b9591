// How a drape puts garments on: tacks, positions and holds, beside the same calls of C++.
#include <algorithm>
#include <cmath>

#include <bodice/tryon/drape.hpp>

#include "capi_whole/dressed.hpp"

using namespace capi_test;
using namespace bodice;

namespace {

/// A dressed body with the handles of C.
struct Wearing {
  Dressed dressed;
  Context context = make_context(2);
  MeshArrays body{dressed.body.mesh};
  Skin skin = make_skin(context, body);
  Proxy proxy = std::move(*skin.fit(context, solid()));

  static bodice_drape_options options() {
    bodice_drape_options options = bodice_default_drape_options();
    options.frames = 10;
    return options;
  }
  /// Drapes one garment; its end, and the report.
  std::vector<double> drape(const bodice_garment& worn, const bodice_drape_options& options,
                            bodice_drape_report& report) const {
    std::vector<double> end(3 * worn.mesh->vertices);
    const bodice_vectors to{end.data(), nullptr, nullptr, 0, BODICE_DOUBLE, 0};
    report = bodice_default_drape_report();
    must(bodice_drape(context.get(), skin.get(), proxy.get(), &worn, 1, &options, &to, &report));
    return end;
  }
};

double highest(const std::vector<double>& xyz) {
  double y = -1e9;
  for (std::size_t i = 1; i < xyz.size(); i += 3) y = std::max(y, xyz[i]);
  return y;
}

}  // namespace

TEST_CASE("capi: a drape finds the unit of a garment in centimeters, on request") {
  Wearing w;
  const geometry::TriMesh& skirt = w.dressed.skirt.mesh;
  MeshArrays arrays(skirt);
  const bodice_mesh mesh = arrays.mesh();
  bodice_drape_report report;
  const std::vector<double> known = w.drape(w.dressed.garment(mesh), Wearing::options(), report);

  MeshArrays centimeters(skirt, 100.0);
  const bodice_mesh far = centimeters.mesh();
  bodice_drape_options options = Wearing::options();
  options.find_position = 1;
  const std::vector<double> placed = w.drape(w.dressed.garment(far), options, report);
  double sum = 0.0;
  for (std::size_t i = 0; i < known.size(); ++i) sum += std::abs(placed[i] - known[i]);
  CHECK(sum / static_cast<double>(known.size()) < 0.001);
  CHECK(report.penetration_end_m < 0.005);

  options.find_position = 0;
  const std::vector<double> left = w.drape(w.dressed.garment(far), options, report);
  CHECK(highest(left) > 50.0);
}

TEST_CASE("capi: a skirt without held vertices falls, and a drape holds it by its waistband on request") {
  Wearing w;
  geometry::TriMesh wide = w.dressed.skirt.mesh;  // the hips stop a skirt that is cut to the waist
  for (geometry::Vec3& p : wide.positions) p.x() *= 1.1, p.z() *= 1.1;
  MeshArrays arrays(wide);
  const bodice_mesh mesh = arrays.mesh();
  bodice_garment loose = w.dressed.garment(mesh);
  loose.held = nullptr;
  loose.held_count = 0;
  bodice_drape_options options = Wearing::options();
  options.frames = 30;
  bodice_drape_report report;
  const double waist = highest(arrays.xyz);
  options.hold = 1;
  const double held = highest(w.drape(loose, options, report));
  options.hold = 0;
  const double fallen = highest(w.drape(loose, options, report));
  CHECK(held > waist - 0.02);
  CHECK(fallen < held - 0.02);
}

TEST_CASE("capi: the distance of tacks reaches the drape, which ends with the bits of C++") {
  Wearing w;
  geometry::TriMesh layers = w.dressed.skirt.mesh;
  const geometry::TriMesh one = layers;
  // A second layer 3 mm farther from the axis of the body.
  const auto first = static_cast<geometry::Index>(one.positions.size());
  for (const geometry::Vec3& p : one.positions)
    layers.positions.push_back(p + 0.003 * geometry::Vec3(p.x(), 0.0, p.z()).normalized());
  for (const auto& t : one.triangles) layers.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  MeshArrays arrays(layers);
  const bodice_mesh mesh = arrays.mesh();
  const auto same = tryon::fit_proxy({}, w.dressed.skin, {.tier = proxy::Tier::kSolid});
  REQUIRE(same);
  std::uint64_t hashes[2];
  int i = 0;
  for (const double tack_m : {0.0, 0.006}) {
    bodice_drape_options options = Wearing::options();
    CHECK(options.tack_m == 0.006);
    options.tack_m = tack_m;
    bodice_drape_report report;
    w.drape(w.dressed.garment(mesh), options, report);
    const auto expected =
        tryon::drape({}, *same, {{"skirt", layers, w.dressed.skirt.held}}, {.frames = 10, .tack_m = tack_m});
    REQUIRE(expected);
    CHECK(report.hash == expected->report.hash);
    hashes[i++] = report.hash;
  }
  CHECK(hashes[0] != hashes[1]);

  bodice_drape_options options = Wearing::options();
  options.tack_m = std::nan("");
  const bodice_garment worn = w.dressed.garment(mesh);
  CHECK(bodice_drape(w.context.get(), w.skin.get(), w.proxy.get(), &worn, 1, &options, nullptr, nullptr) ==
        BODICE_INVALID_ARGUMENT);
}
