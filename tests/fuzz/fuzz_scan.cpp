// Made bodies that the bytes cut, fold, double and set among other things, as scans and games leave them:
// read as a file in which the person is found, repaired, closed, and analyzed.
#include <array>
#include <cmath>
#include <vector>

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/anatomy/measure.hpp>
#include <bodice/geometry/mesh_edges.hpp>
#include <bodice/geometry/mesh_repair.hpp>
#include <bodice/geometry/noise.hpp>
#include <bodice/geometry/rebuild.hpp>
#include <bodice/geometry/thin.hpp>
#include <bodice/io/import.hpp>
#include <bodice/synth/body.hpp>

#include "damage.hpp"
#include "harness.hpp"

using namespace bodice;
using geometry::Index;
using geometry::TriMesh;
using geometry::Vec3;

namespace {

constexpr double kCellsAcross = 40.0;

const TriMesh& body_of(unsigned which) {
  static const std::array<TriMesh, 4> bodies = [] {
    using enum synth::Pose;
    constexpr synth::Pose kPoses[] = {kA, kArmsDown, kSit, kStride};
    std::array<TriMesh, 4> made;
    for (std::size_t k = 0; k < made.size(); ++k) {
      auto body = synth::make_body({}, {.pose = kPoses[k], .vertices = 1500, .seed = k});
      FUZZ_CHECK(body.ok());
      made[k] = std::move(body->mesh);
    }
    return made;
  }();
  return bodies[which % bodies.size()];
}

void check_indices(const TriMesh& mesh) {
  for (const Vec3& p : mesh.positions) FUZZ_CHECK(p.allFinite());
  for (const auto& t : mesh.triangles)
    for (const auto v : t) FUZZ_CHECK(v < mesh.positions.size());
}

std::vector<std::uint8_t> as_ply(const TriMesh& mesh) {
  const std::string head =
      "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.positions.size()) +
      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
      std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  std::vector<std::uint8_t> bytes(head.begin(), head.end());
  const auto put = [&](const auto& value) {
    const auto* from = reinterpret_cast<const std::uint8_t*>(&value);
    bytes.insert(bytes.end(), from, from + sizeof value);
  };
  for (const Vec3& p : mesh.positions)
    for (int k = 0; k < 3; ++k) put(static_cast<float>(p[k]));
  for (const auto& t : mesh.triangles) {
    put(std::uint8_t{3});
    for (const Index v : t) put(static_cast<std::int32_t>(v));
  }
  return bytes;
}

/// The steps of the repair by themselves, with few cells.
void use_steps(const TriMesh& mesh) {
  const auto repaired = geometry::repair({}, mesh);
  fuzz::check_reported(repaired);
  if (!repaired.ok()) return;
  const TriMesh& skin = repaired->mesh;
  check_indices(skin);
  const double across = geometry::bounding_box(skin.positions).size().maxCoeff();
  const geometry::RebuiltSurface rebuilt = geometry::rebuild({}, skin, across / kCellsAcross);
  check_indices(rebuilt.mesh);
  FUZZ_CHECK(geometry::mesh_edges(rebuilt.mesh).boundary == 0);
  const geometry::RoughSurface surface(skin);
  const double noise = geometry::noise_of({}, surface);
  FUZZ_CHECK(std::isfinite(noise) && noise >= 0.0);
  for (const Vec3& p : geometry::without_noise({}, surface, noise)) FUZZ_CHECK(p.allFinite());
  check_indices(geometry::thin_noisy({}, surface, noise, {.edge_m = 0.01 * across}).mesh);
}

/// All of it: the person in the file, and the anatomy.
void use_file(const TriMesh& mesh, io::Shape shape) {
  const fuzz::TemporaryFile file(".ply", as_ply(mesh));
  const auto read = io::import_body({}, file.path(), {.shape = shape});
  fuzz::check_reported(read);
  if (!read.ok()) return;
  check_indices(read->skin);
  FUZZ_CHECK(read->made_up.empty() || read->made_up.size() == read->skin.positions.size());
  if (shape == io::Shape::kAny) return;
  const auto anatomy =
      anatomy::analyze({}, read->skin, {.profile = *body::find_profile("ansur2"), .made_up = read->made_up});
  fuzz::check_reported(anatomy);
  if (!anatomy.ok()) return;
  FUZZ_CHECK(anatomy->part.size() == read->skin.positions.size());
  FUZZ_CHECK(std::isfinite(anatomy->stature_m) && anatomy->stature_m > 0.0);
  for (const body::Landmark& mark : anatomy->landmarks)
    FUZZ_CHECK(mark.confidence == 0.0 || mark.position.allFinite());
  anatomy::measure(read->skin, *anatomy);
}

}  // namespace

FUZZ_TARGET(scan) {
  fuzz::Bytes in(data, size);
  const TriMesh& body = body_of(in.next());
  const unsigned use = in.next() % 8u;
  const TriMesh mesh = fuzz::Damage(in, body).run();
  if (use == 0)
    use_file(mesh, io::Shape::kPerson);
  else if (use < 7)
    use_steps(mesh);
  else
    use_file(mesh, io::Shape::kAny);
  return 0;
}
