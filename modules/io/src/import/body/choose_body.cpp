#include "import/body/choose_body.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string_view>

#include "import/body/join_pieces.hpp"

namespace bodice::inline v0_1::io {

namespace {

using geometry::Index;
using geometry::kNoIndex;

/// The shape of fewer triangles is uncertain.
constexpr double kEnoughTriangles = 100;
/// A closed piece with a smaller share of the area that may be skin is debris among patches.
constexpr double kMainPiece = 0.2;
/// Bodies above this share of the best one's score look alike: a child beside an adult has .5 of its area.
constexpr double kAlike = 0.45;

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
  if (contains_any(name, {"helper", "joint", "eye",    "teeth", "tongue", "hair",  "lash", "brow",
                          "cloth",  "shirt", "jeans",  "pants", "dress",  "skirt", "shoe", "suit",
                          "tights", "floor", "ground", "chair", "stool",  "sofa"}))
    return 0.4;
  return contains_any(name, {"body", "skin", "human"}) ? 2.0 : 1.0;
}

double body_score(const Piece& piece, const FileScene& scene) {
  if (!(piece.box.size().squaredNorm() > 0.0)) return 0.0;
  const double flat = is_flat(piece) ? 1e-3 : 1.0;
  const double compact = is_room(piece) ? 1e-3 : 1.0;
  const double detail = std::min(1.0, static_cast<double>(piece.triangles.size()) / kEnoughTriangles);
  return piece.area * std::exp(-piece.openness()) * flat * compact * detail *
         name_hint(scene.meshes[piece.main_source()]);
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

void report(const FileScene& scene, const std::vector<Piece>& pieces, const std::vector<std::size_t>& body,
            ChosenBody& chosen) {
  std::set<std::size_t> taken, left;
  double total_area = 0.0, left_area = 0.0;
  std::size_t left_count = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Piece& piece = pieces[i];
    const bool in = std::find(body.begin(), body.end(), i) != body.end();
    for (const auto& [source, area] : piece.area_of_source) (in ? taken : left).insert(source);
    total_area += piece.area;
    left_area += in ? 0.0 : piece.area;
    left_count += in ? 0 : 1;
  }
  if (taken.size() > 1)
    chosen.warnings.push_back(engine::note(
        "body-joined", chosen.name, "The body was joined from the meshes " + list_names(scene, taken) + ".",
        "If that is not the body, name its mesh (program: --mesh), or save it alone."));
  if (left_count == 0) return;
  std::set<std::size_t> only_left;
  std::set_difference(left.begin(), left.end(), taken.begin(), taken.end(),
                      std::inserter(only_left, only_left.end()));
  const long rounded = std::lround(100.0 * left_area / total_area);
  const std::string percent = rounded > 0 ? std::to_string(rounded) : "under 1";
  chosen.warnings.push_back(engine::note(
      "pieces-left-out", chosen.name,
      std::to_string(left_count) + (left_count == 1 ? " loose piece" : " loose pieces") + " with " + percent +
          " % of the file's surface" + (only_left.empty() ? "" : " (" + list_names(scene, only_left) + ")") +
          (left_count == 1 ? " was" : " were") + " left out: not the body's skin.",
      "If that is wrong, name the body's mesh (program: --mesh), or save it alone."));
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

std::vector<bool> vertices_of(const JoinedScene& joined, const std::vector<Piece>& pieces,
                              const std::vector<std::size_t>& body) {
  std::vector<bool> in(joined.mesh.positions.size());
  for (const std::size_t i : body)
    for (const Index t : pieces[i].triangles)
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

/// The piece to begin with: the one with the most closed skin; where that is a crumb of what may be skin, the
/// largest.
std::size_t seed_of(const FileScene& scene, const std::vector<Piece>& pieces) {
  std::vector<double> score;
  double area = 0.0;
  std::size_t largest = pieces.size();  // they are sorted by area
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    score.push_back(body_score(pieces[i], scene));
    if (is_flat(pieces[i]) || is_room(pieces[i])) continue;
    area += pieces[i].area;
    largest = std::min(largest, i);
  }
  // A floor is more closed than a scan with many holes, but never the body.
  if (area > 0.0)
    for (std::size_t i = 0; i < pieces.size(); ++i)
      if (is_flat(pieces[i]) || is_room(pieces[i])) score[i] = 0.0;
  const auto best =
      static_cast<std::size_t>(std::distance(score.begin(), std::max_element(score.begin(), score.end())));
  return pieces[best].area < kMainPiece * area ? largest : best;
}

/// The pieces that people begin with. Where several look alike, the file's order numbers them.
std::vector<std::size_t> people_in(const engine::Context& context, const FileScene& scene,
                                   const JoinedScene& joined, const std::vector<Piece>& pieces,
                                   const std::vector<std::size_t>& body) {
  std::vector<std::size_t> people = other_people(context, joined, pieces, body);
  people.insert(people.begin(), body.front());
  const double best = body_score(pieces[body.front()], scene);
  const auto alike = std::stable_partition(people.begin(), people.end(), [&](std::size_t i) {
    return body_score(pieces[i], scene) > kAlike * best;
  });
  std::sort(people.begin(), alike, [&](std::size_t a, std::size_t b) {
    return pieces[a].triangles.front() < pieces[b].triangles.front();
  });
  return people;
}

/// Body number `person` of the file.
engine::Result<std::vector<std::size_t>> pieces_of_person(const engine::Context& context,
                                                          const FileScene& scene, const JoinedScene& joined,
                                                          const std::vector<Piece>& pieces, int person,
                                                          ChosenBody& chosen) {
  std::vector<std::size_t> body = join_pieces(context, joined, pieces, seed_of(scene, pieces));
  const std::vector<std::size_t> people = people_in(context, scene, joined, pieces, body);
  const auto count = static_cast<int>(people.size());
  if (person > count || person < 1)
    return engine::Error{engine::ErrorCode::kNotFound,
                         "There is no person " + std::to_string(person) + " in the file.",
                         "Give a number from 1 to " + std::to_string(count) + "."};
  if (count > 1)
    chosen.warnings.push_back(
        engine::note("several-people", "",
                     "The file holds " + std::to_string(count) + " bodies; number " + std::to_string(person) +
                         " was taken.",
                     "Choose another by its number (program: --person), or save one body alone."));
  const std::size_t wanted = people[static_cast<std::size_t>(person - 1)];
  if (wanted == body.front()) return body;
  return join_pieces(context, joined, pieces, wanted);
}

}  // namespace

engine::Result<ChosenBody> choose_all(const FileScene& scene, const std::optional<std::string>& wanted) {
  if (!wanted) return take_all(scene);
  const auto meshes = named(scene, *wanted);
  if (!meshes) return meshes.error();
  return take_all(*meshes);
}

engine::Result<ChosenBody> choose_body(const engine::Context& context, const FileScene& scene,
                                       const std::optional<std::string>& wanted, int person) {
  if (wanted) {
    const auto meshes = named(scene, *wanted);
    if (!meshes) return meshes.error();
    return take_all(*meshes);
  }
  auto joined = join(context, scene);
  if (!joined) return joined.error();
  if (joined->repaired.report.components == 1 && scene.meshes.size() == 1 && person == 1) {
    ChosenBody chosen = take_all(scene);
    chosen.repaired = std::move(joined->repaired);
    chosen.repaired->mesh = std::move(joined->mesh);
    return chosen;
  }
  const std::vector<Piece> pieces = split(*joined);

  ChosenBody chosen;
  const auto body = pieces_of_person(context, scene, *joined, pieces, person, chosen);
  if (!body) return body.error();
  chosen.name = label(scene.meshes[pieces[body->front()].main_source()]);
  gather(scene, *joined, vertices_of(*joined, pieces, *body), chosen);
  report(scene, pieces, *body, chosen);
  return chosen;
}

}  // namespace bodice::io
