// A rig in Collada: a controller with its bind shape, joints as matrices, an animation of matrices.
#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>
#include <sstream>

#include <Eigen/Geometry>
#include <bodice/io/rig.hpp>
#include <bodice_test/temp_folder.hpp>

#include "made_rig.hpp"

using namespace bodice;
using namespace io_test;
using bodice_test::TempFolder;
using Eigen::Affine3d;
using Eigen::AngleAxisd;
using Eigen::Translation3d;

namespace {

std::string row_major(const Affine3d& map) {
  std::ostringstream out;
  out.precision(9);
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) out << map.matrix()(row, column) << ' ';
  return out.str();
}

/// `params`: one element a column, such as <param name="X" type="float"/>.
std::string source(const std::string& id, const char* array, const std::string& values, std::size_t count,
                   std::size_t stride, const std::string& params) {
  return "<source id=\"" + id + "\"><" + array + " id=\"" + id + "-a\" count=\"" +
         std::to_string(count * stride) + "\">" + values + "</" + array +
         "><technique_common><accessor source=\"#" + id + "-a\" count=\"" + std::to_string(count) +
         "\" stride=\"" + std::to_string(stride) + "\">" + params + "</accessor></technique_common></source>";
}

std::string param(const char* name, const char* type) {
  return std::string("<param name=\"") + name + "\" type=\"" + type + "\"/>";
}

/// What the file states, in its own units: centimeters, z up.
struct Truth {
  Affine3d shape =
      Translation3d(5, -3, 20) * AngleAxisd(0.2, Vec3::UnitZ());  // of the mesh when it was bound
  Affine3d low = Affine3d(Translation3d(0, 0, 40)), high = Affine3d(Translation3d(0, 0, 50));
  Affine3d turned =
      Translation3d(0, 0, 50) * AngleAxisd(std::numbers::pi / 2, Vec3::UnitX());  // of high, second 2

  /// A vertex that belongs to `low` (share 0) to `high` (share 1), at second 2.
  Vec3 posed(const Vec3& v, double share) const {
    const Vec3 bound = shape * v;
    return (1.0 - share) * bound + share * (low * turned * (low * high).inverse() * bound);
  }
};

double share_of(const Vec3& v) {
  return v.z() > 110.0 ? 1.0 : v.z() > 80.0 ? 0.25 : 0.0;
}

std::string document(const TriMesh& mesh, const Truth& truth) {
  std::ostringstream points, corners, counts, entries;
  points.precision(9);
  for (const Vec3& p : mesh.positions) {
    points << p.x() << ' ' << p.y() << ' ' << p.z() << ' ';
    counts << "2 ";
    const std::size_t weights = share_of(p) == 1.0    ? 1
                                : share_of(p) == 0.25 ? 2
                                                      : 0;  // 0: (1, 0), 1: (0, 1), 2
    entries << (weights == 0 ? "0 0 1 1 " : weights == 1 ? "0 1 1 0 " : "0 3 1 2 ");
  }
  for (const auto& t : mesh.triangles) corners << t[0] << ' ' << t[1] << ' ' << t[2] << ' ';
  const std::size_t n = mesh.positions.size();
  return "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
         "version=\"1.4.1\">"
         "<asset><unit name=\"centimeter\" meter=\"0.01\"/><up_axis>Z_UP</up_axis></asset>"
         "<library_geometries><geometry id=\"body\" name=\"body\"><mesh>" +
         source("pos", "float_array", points.str(), n, 3,
                param("X", "float") + param("Y", "float") + param("Z", "float")) +
         "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#pos\"/></vertices><triangles count=\"" +
         std::to_string(mesh.triangles.size()) +
         "\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>" + corners.str() +
         "</p></triangles></mesh></geometry></library_geometries><library_controllers><controller "
         "id=\"skin\"><skin "
         "source=\"#body\"><bind_shape_matrix>" +
         row_major(truth.shape) + "</bind_shape_matrix>" +
         source("names", "Name_array", "low high", 2, 1, param("JOINT", "name")) +
         source("binds", "float_array",
                row_major(truth.low.inverse()) + row_major((truth.low * truth.high).inverse()), 2, 16,
                param("TRANSFORM", "float4x4")) +
         source("weights", "float_array", "1 0 0.25 0.75", 4, 1, param("WEIGHT", "float")) +
         "<joints><input semantic=\"JOINT\" source=\"#names\"/><input semantic=\"INV_BIND_MATRIX\" "
         "source=\"#binds\"/></joints><vertex_weights count=\"" +
         std::to_string(n) +
         "\"><input semantic=\"JOINT\" source=\"#names\" offset=\"0\"/><input semantic=\"WEIGHT\" "
         "source=\"#weights\" "
         "offset=\"1\"/><vcount>" +
         counts.str() + "</vcount><v>" + entries.str() +
         "</v></vertex_weights></skin></controller></library_controllers><library_animations><animation "
         "id=\"turn\">" +
         source("t", "float_array", "0 2", 2, 1, param("TIME", "float")) +
         source("m", "float_array", row_major(truth.high) + row_major(truth.turned), 2, 16,
                param("TRANSFORM", "float4x4")) +
         source("i", "Name_array", "LINEAR LINEAR", 2, 1, param("INTERPOLATION", "name")) +
         "<sampler id=\"s\"><input semantic=\"INPUT\" source=\"#t\"/><input semantic=\"OUTPUT\" "
         "source=\"#m\"/><input "
         "semantic=\"INTERPOLATION\" source=\"#i\"/></sampler><channel source=\"#s\" "
         "target=\"high/transform\"/>"
         "</animation></library_animations><library_visual_scenes><visual_scene id=\"scene\"><node "
         "id=\"low\" sid=\"low\" "
         "name=\"low\" type=\"JOINT\"><matrix sid=\"transform\">" +
         row_major(truth.low) +
         "</matrix><node id=\"high\" sid=\"high\" name=\"high\" type=\"JOINT\"><matrix sid=\"transform\">" +
         row_major(truth.high) +
         "</matrix></node></node><node id=\"holder\"><instance_controller "
         "url=\"#skin\"><skeleton>#low</skeleton>"
         "</instance_controller></node></visual_scene></library_visual_scenes><scene><instance_visual_scene "
         "url=\"#scene\"/></scene></COLLADA>";
}

}  // namespace

TEST_CASE("a Collada rig in centimeters, z up, poses each vertex where its matrices put it") {
  const TempFolder folder;
  const TriMesh mesh =
      mapped(figure(), [](const Vec3& p) { return Vec3(100 * p.x(), -100 * p.z(), 100 * p.y()); });
  const Truth truth;
  const auto body = io::import_rigged_body({}, folder.write("rig.dae", document(mesh, truth)));
  const std::string why = body.ok() ? "" : body.error().message;
  CAPTURE(why);
  REQUIRE(body.ok());
  REQUIRE(body->rig.ok());
  CHECK(body->body.unit == "cm");
  REQUIRE(body->rig->clips.size() == 1);
  CHECK(body->rig->clips[0].duration_s == doctest::Approx(2.0));
  const auto now = posed(body->body.skin, *body->rig, body->rig->clips[0], 2.0);
  // The reader numbers input vertices by first use, so that posed points are matched by their bound ones.
  double worst = 0.0;
  for (const Vec3& v : mesh.positions) {
    const Vec3 bound = body->body.frame.to_inside(truth.shape * v);
    std::size_t at = 0;
    for (std::size_t i = 1; i < now.size(); ++i)
      if ((body->body.skin.positions[i] - bound).norm() < (body->body.skin.positions[at] - bound).norm())
        at = i;
    REQUIRE((body->body.skin.positions[at] - bound).norm() < 5e-6);
    worst = std::max(worst, (now[at] - body->body.frame.to_inside(truth.posed(v, share_of(v)))).norm());
  }
  CHECK(worst < 5e-6);
}
