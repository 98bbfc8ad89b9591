#include <bodice/synth/thing.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "scan/flaws.hpp"
#include "scan/props.hpp"

namespace bodice::inline v0_1::synth {
namespace {

using geometry::Box;
using geometry::DistanceField;
using geometry::TriMesh;
using geometry::Vec3;

/// Where the seat of a chair is that stands on the floor.
const Vec3 kSeatOnFloor(0.0, 0.45, 0.0);

/// The region that a ball sweeps along a line.
struct Rod {
  Vec3 from, to;
  double radius_m;
};

double distance_to(const Rod& rod, const Vec3& p) {
  const Vec3 along = rod.to - rod.from;
  const double t = std::clamp((p - rod.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - rod.from - t * along).norm() - rod.radius_m;
}

DistanceField around(std::vector<Rod> rods) {
  return [rods = std::move(rods)](const Vec3& p) {
    double least = 1e9;
    for (const Rod& rod : rods) least = std::min(least, distance_to(rod, p));
    return least;
  };
}

DistanceField around(std::vector<Box> boxes) {
  return [boxes = std::move(boxes)](const Vec3& p) {
    double least = 1e9;
    for (const Box& box : boxes) least = std::min(least, distance_to_box(box, p));
    return least;
  };
}

TriMesh loose(const std::vector<Box>& boxes, double edge_m) {
  TriMesh mesh;
  for (const Box& box : boxes) append(box_mesh(box, edge_m), mesh);
  return mesh;
}

/// A field and a box that holds its surface.
struct Shape {
  DistanceField distance;
  Box box;
};

Shape shape_of(std::vector<Rod> rods) {
  Box box;
  for (const Rod& rod : rods)
    for (const Vec3& end : {rod.from, rod.to})
      box.extend((end.array() - rod.radius_m).matrix()), box.extend((end.array() + rod.radius_m).matrix());
  return {around(std::move(rods)), box};
}

Shape torso() {
  return shape_of({{{-0.08, 0.18, 0.0}, {0.08, 0.18, 0.0}, 0.13},
                   {{0.0, 0.18, 0.0}, {0.0, 0.45, 0.0}, 0.12},
                   {{-0.12, 0.52, 0.0}, {0.12, 0.52, 0.0}, 0.1},
                   {{0.0, 0.55, 0.0}, {0.0, 0.7, -0.01}, 0.055}});
}

Shape dog() {
  std::vector<Rod> rods = {{{0.0, 0.5, -0.28}, {0.0, 0.52, 0.28}, 0.14},
                           {{0.0, 0.58, 0.34}, {0.0, 0.76, 0.5}, 0.075},
                           {{0.0, 0.78, 0.5}, {0.0, 0.74, 0.66}, 0.07},
                           {{0.0, 0.56, -0.36}, {0.0, 0.72, -0.62}, 0.025}};
  for (const double x : {-0.09, 0.09})
    for (const double z : {-0.26, 0.26}) rods.push_back({{x, 0.42, z}, {x, 0.04, z}, 0.04});
  return shape_of(std::move(rods));
}

Shape hand() {
  std::vector<Rod> rods = {{{0.02, 0.03, 0.0}, {0.055, 0.065, 0.005}, 0.012}};
  for (int finger = 0; finger < 4; ++finger) {
    const double x = 0.03 - 0.02 * finger, length = 0.065 + (finger == 1 || finger == 2 ? 0.012 : 0.0);
    rods.push_back({{x, 0.015, 0.0}, {x, 0.085, 0.0}, 0.014});
    rods.push_back({{x, 0.085, 0.0}, {1.15 * x, 0.085 + length, 0.0}, 0.009});
  }
  return shape_of(std::move(rods));
}

Thing contoured(const engine::Context& context, Shape shape, double edge_m) {
  TriMesh mesh =
      geometry::contour(context, geometry::sample_field(context, shape.distance, shape.box, edge_m));
  return {std::move(mesh), std::move(shape.distance)};
}

}  // namespace

std::string_view name(ThingKind kind) {
  constexpr std::array<std::string_view, kThingKindCount> kThingNames = {"cube",  "chair", "joined chair",
                                                                         "torso", "dog",   "hand"};
  return kThingNames[static_cast<std::size_t>(kind)];
}

Thing make_thing(const engine::Context& context, ThingKind kind, double edge_m) {
  const std::vector<Box> boards = chair(kSeatOnFloor);
  const Box cube{{-0.25, 0.0, -0.25}, {0.25, 0.5, 0.25}};
  switch (kind) {
    case ThingKind::kChair:
      return {loose(boards, edge_m), around(boards)};
    case ThingKind::kJoined: {
      Box box;
      for (const Box& board : boards) box.extend(board.low), box.extend(board.high);
      return contoured(context, {around(boards), box}, edge_m);
    }
    case ThingKind::kTorso:
      return contoured(context, torso(), edge_m);
    case ThingKind::kDog:
      return contoured(context, dog(), edge_m);
    case ThingKind::kHand:
      return contoured(context, hand(), edge_m);
    default:
      return {box_mesh(cube, edge_m), around(std::vector{cube})};
  }
}

TriMesh make_chair(const Vec3& seat, double edge_m) {
  return loose(chair(seat), edge_m);
}

Vec3 seat_of(const Body& body) {
  constexpr double kAround_m = 0.15, kToFront_m = 0.08;
  double low = 1e9;
  Vec3 pelvis = Vec3::Zero();
  for (const Joint& joint : body.joints)
    if (joint.name == "pelvis") pelvis = joint.position;
  for (const Vec3& p : body.mesh.positions)
    if (std::hypot(p.x() - pelvis.x(), p.z() - pelvis.z()) < kAround_m) low = std::min(low, p.y());
  return {pelvis.x(), low, pelvis.z() + kToFront_m};
}

}  // namespace bodice::synth
