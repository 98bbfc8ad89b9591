#include "import/body/join_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include <bodice/geometry/mesh_distance.hpp>

namespace bodice::inline v0_1::io {

namespace {

using geometry::Index;
using geometry::Vec3;

// Ratios that distinguish a body from what lies in, on and around it.
constexpr double kFlat = 0.05;    ///< thickness to length: floors and cards are flatter, bodies never
constexpr double kCompact = 1.5;  ///< area to squared diagonal: a crouching body .8, a sphere 1.05, a room 2
constexpr double kLargestLimb = 1.5;   ///< of the seed's area: larger is a room or a stage
constexpr double kTinyPiece = 0.002;   ///< of the seed's area: a smaller piece is ignored
constexpr double kNear = 0.04;         ///< of the body's length: a piece this close follows its skin
constexpr double kTouching = 0.08;     ///< of the body's length: a piece this close may continue it
constexpr double kContinues = 0.03;    ///< of the body's length: a piece that adds this much does
constexpr double kClosedLimb = 1.4;    ///< openness; an arm that is open at its shoulder has 1.2
constexpr double kClosed = 0.6;        ///< openness; a body with open eyes, mouth and soles has .5
constexpr std::size_t kSamples = 400;  ///< vertices measured on each piece
/// Planes that hold this share of a piece's area make it flat-sided; a body's skin has a tenth in them.
constexpr std::size_t kPlanes = 6;
constexpr double kPlaneShare = 0.6;
constexpr double kNormalCells = 16.0;  ///< of a normal's components from 0 to 1: 4 degrees
// A person beside the body has at least these shares of its area and of its length.
constexpr double kPersonArea = 0.35, kPersonLength = 0.5;

geometry::TriMesh mesh_of(const JoinedScene& joined, const std::vector<Piece>& pieces,
                          const std::vector<std::size_t>& chosen) {
  geometry::TriMesh mesh;
  mesh.positions = joined.mesh.positions;
  for (const std::size_t i : chosen)
    for (const Index t : pieces[i].triangles) mesh.triangles.push_back(joined.mesh.triangles[t]);
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

/// The length by which the piece would extend the body along its longest side, as a fraction of that side.
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

/// Whether an open piece belongs to a body of open pieces.
bool is_near(const JoinedScene& joined, const Piece& piece, const geometry::Box& box,
             const geometry::MeshDistance& body) {
  const double length = box.size().maxCoeff();
  return relate(joined, piece, body, kNear * length).gap <= kTouching * length;
}

/// Whether a closed piece is as long as the body and lies along it: a limb lies beyond one of its ends.
bool stands_beside(const geometry::Box& body, const Piece& piece) {
  Eigen::Index longest = 0;
  const double length = body.size().maxCoeff(&longest);
  const double shared = std::min(body.high[longest], piece.box.high[longest]) -
                        std::max(body.low[longest], piece.box.low[longest]);
  return is_closed(piece) && shared > kPersonLength * length &&
         piece.box.size().maxCoeff() > kPersonLength * length;
}

}  // namespace

bool is_flat_sided(const JoinedScene& joined, const Piece& piece) {
  std::map<std::array<int, 3>, double> area_of_normal;
  for (const Index t : piece.triangles) {
    const Vec3 normal = area_vector(joined.mesh, t);
    const double area = normal.norm();
    std::array<int, 3> key{};
    for (int k = 0; k < 3; ++k)
      key[static_cast<std::size_t>(k)] = static_cast<int>(std::lround(kNormalCells * normal[k] / area));
    if (area > 0.0) area_of_normal[key] += 0.5 * area;
  }
  std::vector<double> areas;
  for (const auto& [key, area] : area_of_normal) areas.push_back(area);
  std::sort(areas.rbegin(), areas.rend());
  double largest = 0.0;
  for (std::size_t i = 0; i < std::min(kPlanes, areas.size()); ++i) largest += areas[i];
  return largest > kPlaneShare * piece.area;
}

bool is_flat(const Piece& piece) {
  const Vec3 size = piece.box.size();
  return size.minCoeff() < kFlat * size.maxCoeff();
}

bool is_room(const Piece& piece) {
  return piece.area > kCompact * piece.box.size().squaredNorm();
}

bool is_closed(const Piece& piece) {
  return piece.openness() < kClosed;
}

std::vector<std::size_t> join_pieces(const engine::Context& context, const JoinedScene& joined,
                                     const std::vector<Piece>& pieces, std::size_t seed) {
  const bool closed = is_closed(pieces[seed]), of_planes = is_flat_sided(joined, pieces[seed]);
  std::vector<std::size_t> body = {seed};
  std::vector<bool> left(pieces.size());  // taken, or never part of this body
  for (std::size_t i = 0; i < pieces.size(); ++i)
    left[i] = i == seed || pieces[i].area < kTinyPiece * pieces[seed].area ||
              (closed && pieces[i].area > kLargestLimb * pieces[seed].area) ||
              (!closed && (is_flat(pieces[i]) || is_room(pieces[i]))) ||
              (!of_planes && is_flat_sided(joined, pieces[i]));
  geometry::Box box = pieces[seed].box;
  for (bool grown = true; grown;) {  // ends, because every round takes a piece
    grown = false;
    const geometry::MeshDistance distance(context, mesh_of(joined, pieces, body));
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (left[i]) continue;
      const bool joins =
          closed ? !stands_beside(box, pieces[i]) && continues_body(joined, pieces[i], box, distance)
                 : is_near(joined, pieces[i], box, distance);
      if (!joins) continue;
      body.push_back(i);
      left[i] = grown = true;
    }
    for (const std::size_t i : body) box.extend(pieces[i].box.low), box.extend(pieces[i].box.high);
  }
  return body;
}

std::vector<std::size_t> other_people(const engine::Context& context, const JoinedScene& joined,
                                      const std::vector<Piece>& pieces,
                                      const std::vector<std::size_t>& body) {
  const Piece& seed = pieces[body.front()];
  const double length = seed.box.size().maxCoeff();
  std::vector<std::size_t> people;
  if (!is_closed(seed)) return people;
  const geometry::MeshDistance distance(context, mesh_of(joined, pieces, body));
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Piece& piece = pieces[i];
    if (std::find(body.begin(), body.end(), i) != body.end() || !is_closed(piece) || is_flat(piece) ||
        is_room(piece) || piece.area < kPersonArea * seed.area ||
        piece.box.size().maxCoeff() < kPersonLength * length || is_flat_sided(joined, piece))
      continue;
    if (relate(joined, piece, distance, kNear * length).near_fraction < 0.5) people.push_back(i);
  }
  return people;
}

}  // namespace bodice::io
