#include "choose_body.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <string_view>

#include <bodice/geometry/mesh_distance.hpp>

#include "piece.hpp"

namespace bodice::io {

namespace {

using geometry::Index;
using geometry::kNoIndex;
using geometry::Vec3;

// Ratios that distinguish a body from what lies in, on and around it.
constexpr double kFlat = 0.05;    ///< thickness to length: floors and cards are flatter, bodies never
constexpr double kCompact = 1.5;  ///< area to squared diagonal: a crouching body .8, a sphere 1.05, a room 2
constexpr double kEnoughTriangles = 100;  ///< the shape of fewer triangles is uncertain
constexpr double kLargestLimb = 1.5;      ///< of the best piece's area: larger is a room or a stage
constexpr double kTinyPiece = 0.002;      ///< of the body's area: a smaller piece is ignored
constexpr double kNear = 0.04;            ///< of the body's length: a piece this close follows its skin
constexpr double kTouching = 0.08;        ///< of the body's length: a piece this close may continue it
constexpr double kContinues = 0.03;       ///< of the body's length: a piece that adds this much does
constexpr double kClosedLimb = 1.4;       ///< openness of an arm open at its shoulder: 1.2
constexpr std::size_t kSamples = 400;     ///< vertices measured on each piece

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

bool contains_any(std::string_view text, std::initializer_list<std::string_view> words) {
  const std::string in = lower(text);
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return in.find(word) != std::string::npos; });
}

/// A factor from the names. Shape can overrule it, since names are often missing, foreign or wrong.
double name_hint(const FileMesh& mesh) {
  const std::string name = mesh.name + ' ' + mesh.material;
  if (contains_any(name,
                   {"helper", "joint", "eye", "teeth", "tongue", "hair", "lash", "brow", "cloth", "shirt",
                    "jeans", "pants", "dress", "skirt", "shoe", "suit", "tights", "floor", "ground"}))
    return 0.4;
  return contains_any(name, {"body", "skin", "human"}) ? 2.0 : 1.0;
}

double body_score(const Piece& piece, const FileScene& scene) {
  const Vec3 size = piece.box.size();
  const double diagonal_squared = size.squaredNorm();
  if (!(diagonal_squared > 0.0)) return 0.0;
  const double flat = size.minCoeff() < kFlat * size.maxCoeff() ? 1e-3 : 1.0;
  const double compact = piece.area > kCompact * diagonal_squared ? 1e-3 : 1.0;
  const double detail = std::min(1.0, static_cast<double>(piece.triangles.size()) / kEnoughTriangles);
  return piece.area * std::exp(-piece.openness()) * flat * compact * detail *
         name_hint(scene.meshes[piece.main_source()]);
}

geometry::TriMesh mesh_of(const JoinedScene& joined, const std::vector<const Piece*>& pieces) {
  geometry::TriMesh mesh;
  mesh.positions = joined.mesh.positions;
  for (const Piece* piece : pieces)
    for (const Index t : piece->triangles) mesh.triangles.push_back(joined.mesh.triangles[t]);
  return mesh;
}

/// How a piece lies in relation to the body found so far.
struct Relation {
  double near_fraction = 0.0;  ///< share of its vertices inside the body or close to its skin
  double gap = 0.0;            ///< distance between them, file units; 0 if any vertex is inside
};

Relation relate(const JoinedScene& joined, const Piece& piece, const geometry::MeshDistance& body,
                double near_distance) {
  const std::size_t step = std::max<std::size_t>(1, piece.triangles.size() / kSamples);
  std::size_t measured = 0, near = 0;
  double gap = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < piece.triangles.size(); i += step, ++measured) {
    const double distance = body.signed_distance(joined.mesh.corner(piece.triangles[i], 0));
    near += distance < near_distance;
    gap = std::min(gap, std::max(0.0, distance));
  }
  return {static_cast<double>(near) / static_cast<double>(std::max<std::size_t>(measured, 1)), gap};
}

/// By how much the piece would extend the body along its longest side, as a fraction of that side.
double growth(const geometry::Box& body, const geometry::Box& piece) {
  Eigen::Index longest = 0;
  const double length = body.size().maxCoeff(&longest);
  const double low = std::min(body.low[longest], piece.low[longest]);
  const double high = std::max(body.high[longest], piece.high[longest]);
  return (high - low) / length - 1.0;
}

bool continues_body(const JoinedScene& joined, const Piece& piece, const geometry::Box& box,
                    const geometry::MeshDistance& body) {
  const double length = box.size().maxCoeff();
  const Relation relation = relate(joined, piece, body, kNear * length);
  if (relation.near_fraction >= 0.5 || relation.gap > kTouching * length) return false;
  return piece.openness() < kClosedLimb || growth(box, piece.box) >= kContinues;
}

/// Extends the body from its best piece by the pieces that continue it: limbs, or legs that exist only as
/// trousers.
std::vector<const Piece*> grow(const engine::Context& context, const JoinedScene& joined,
                               const std::vector<Piece>& pieces, std::size_t best) {
  std::vector<const Piece*> body = {&pieces[best]};
  std::vector<bool> taken(pieces.size());
  taken[best] = true;
  geometry::Box box = pieces[best].box;
  for (bool grown = true; grown;) {  // ends, because every round takes a piece
    grown = false;
    const geometry::MeshDistance distance(context, mesh_of(joined, body));
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (taken[i] || pieces[i].area < kTinyPiece * pieces[best].area ||
          pieces[i].area > kLargestLimb * pieces[best].area)
        continue;
      if (!continues_body(joined, pieces[i], box, distance)) continue;
      body.push_back(&pieces[i]);
      taken[i] = grown = true;
    }
    for (const Piece* piece : body) box.extend(piece->box.low), box.extend(piece->box.high);
  }
  return body;
}

std::string label(const FileMesh& mesh) {
  if (mesh.name.empty()) return mesh.material.empty() ? "(unnamed)" : mesh.material;
  return mesh.name;
}

/// The first few distinct names, in quotes.
std::string list_names(const FileScene& scene, const std::set<std::size_t>& sources) {
  constexpr std::size_t kShown = 6;
  std::vector<std::string> names;
  for (const std::size_t s : sources) {
    std::string name = label(scene.meshes[s]);
    if (std::any_of(scene.meshes.begin(), scene.meshes.end(), [&](const FileMesh& other) {
          return label(other) == name && other.material != scene.meshes[s].material;
        }))
      name += '/' + scene.meshes[s].material;
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, names.size()); ++i) text += (i ? ", '" : "'") + names[i] + "'";
  if (names.size() > kShown) text += " and " + std::to_string(names.size() - kShown) + " more";
  return text;
}

void report(const FileScene& scene, const std::vector<Piece>& pieces, const std::vector<const Piece*>& body,
            ChosenBody& chosen) {
  std::set<std::size_t> taken, left;
  double total_area = 0.0, left_area = 0.0;
  std::size_t left_count = 0;
  for (const Piece& piece : pieces) {
    const bool in = std::find(body.begin(), body.end(), &piece) != body.end();
    for (const auto& [source, area] : piece.area_of_source) (in ? taken : left).insert(source);
    total_area += piece.area;
    left_area += in ? 0.0 : piece.area;
    left_count += in ? 0 : 1;
  }
  if (taken.size() > 1)
    chosen.warnings.push_back({"body-joined", chosen.name,
                               "The body was joined from the meshes " + list_names(scene, taken) + ".",
                               "Name one with --mesh if that is not the body."});
  if (left_count == 0) return;
  std::set<std::size_t> only_left;
  std::set_difference(left.begin(), left.end(), taken.begin(), taken.end(),
                      std::inserter(only_left, only_left.end()));
  const long rounded = std::lround(100.0 * left_area / total_area);
  const std::string percent = rounded > 0 ? std::to_string(rounded) : "under 1";
  chosen.warnings.push_back({"pieces-left-out", chosen.name,
                             std::to_string(left_count) +
                                 (left_count == 1 ? " loose piece" : " loose pieces") + " with " + percent +
                                 " % of the file's surface" +
                                 (only_left.empty() ? "" : " (" + list_names(scene, only_left) + ")") +
                                 (left_count == 1 ? " was" : " were") + " left out: not the body's skin.",
                             "Name the body's mesh with --mesh if that is wrong."});
}

/// The chosen triangles as in the file, flaws included, which repair will report. `wanted` is indexed by
/// joined vertex.
void gather(const FileScene& scene, const JoinedScene& joined, const std::vector<bool>& wanted,
            ChosenBody& chosen) {
  geometry::TriMesh& shape = chosen.shape;
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const geometry::TriMesh& mesh = scene.meshes[m].shape;
    const Index first = static_cast<Index>(shape.positions.size());
    for (const geometry::Triangle& t : mesh.triangles) {
      const bool in = std::any_of(t.begin(), t.end(), [&](Index v) {
        const Index vertex = joined.vertex_of[m][v];
        return vertex != kNoIndex && wanted[vertex];
      });
      if (in) shape.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    const bool used = !shape.triangles.empty() && shape.triangles.back()[0] >= first;
    if (!used) continue;
    shape.positions.insert(shape.positions.end(), mesh.positions.begin(), mesh.positions.end());
    append(scene.meshes[m].weights, chosen.weights);
  }
}

std::vector<bool> vertices_of(const JoinedScene& joined, const std::vector<const Piece*>& pieces) {
  std::vector<bool> in(joined.mesh.positions.size());
  for (const Piece* piece : pieces)
    for (const Index t : piece->triangles)
      for (const Index v : joined.mesh.triangles[t]) in[v] = true;
  return in;
}

/// The meshes of one name, regardless of case.
engine::Result<FileScene> named(const FileScene& scene, const std::string& wanted) {
  FileScene found;
  std::set<std::size_t> all;
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    all.insert(m);
    const FileMesh& mesh = scene.meshes[m];
    if (lower(mesh.name) == lower(wanted) || lower(mesh.name + '/' + mesh.material) == lower(wanted))
      found.meshes.push_back(mesh);
  }
  if (!found.meshes.empty()) return found;
  return engine::Error{engine::ErrorCode::kNotFound, "There is no mesh named '" + wanted + "' in the file.",
                       "It has " + list_names(scene, all) + "."};
}

ChosenBody take_all(const FileScene& scene) {
  ChosenBody chosen;
  chosen.name = label(scene.meshes.front());
  for (const FileMesh& mesh : scene.meshes) {
    append(mesh.shape, chosen.shape);
    append(mesh.weights, chosen.weights);
  }
  return chosen;
}

}  // namespace

engine::Result<ChosenBody> choose_body(const engine::Context& context, const FileScene& scene,
                                       const std::optional<std::string>& wanted) {
  if (wanted) {
    const auto meshes = named(scene, *wanted);
    if (!meshes) return meshes.error();
    return take_all(*meshes);
  }
  auto joined = join(context, scene);
  if (!joined) return joined.error();
  const std::vector<Piece> pieces = split(*joined);
  if (pieces.size() == 1 && scene.meshes.size() == 1) return take_all(scene);

  std::vector<double> score;
  for (const Piece& piece : pieces) score.push_back(body_score(piece, scene));
  const auto best = std::max_element(score.begin(), score.end());
  const std::vector<const Piece*> body =
      grow(context, *joined, pieces, static_cast<std::size_t>(std::distance(score.begin(), best)));
  ChosenBody chosen;
  chosen.name = label(scene.meshes[body.front()->main_source()]);
  gather(scene, *joined, vertices_of(*joined, body), chosen);
  report(scene, pieces, body, chosen);
  return chosen;
}

}  // namespace bodice::io
