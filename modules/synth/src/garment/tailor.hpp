// Garments as grids of points around or over a trunk.
#pragma once

#include <bodice/engine/context.hpp>

#include <bodice/geometry/mesh_distance.hpp>

#include "garment/outline.hpp"

namespace bodice::inline v0_1::synth {

/// The body, its frame and distance, and the options of every cut.
struct Fitting {
  const SegmentedBody& body;
  const GarmentOptions& options;
  TrunkFrame frame;
  LocalSkin skin;
  geometry::MeshDistance distance;  ///< in the world
  double signed_distance(const Vec3& local) const { return distance.signed_distance(frame.to_world(local)); }
};

/// A garment being cut. Positions are in the trunk's frame until finish() turns them to the world.
struct Cut {
  geometry::TriMesh mesh;
  std::vector<geometry::Index> pinned;
  std::vector<Vec3> outward;  ///< #V: direction in which a vertex is moved off the skin
};

engine::Result<Cut> cut_skirt(const Fitting& fitting);
engine::Result<Cut> cut_tube(const Fitting& fitting);
engine::Result<Cut> cut_tunic(const Fitting& fitting);
engine::Result<Cut> cut_poncho(const Fitting& fitting);

/// Heights of a garment's landmarks in the trunk's frame.
struct Levels {
  double waist, armpit, neck;
};
Levels levels_of(const Fitting& fitting);
/// The greatest height below the armpits at which there is room for cloth between trunk and arm. It is found
/// on the skin itself, because an armpit's landmark may be some centimeters above the fold.
double tube_top(const Fitting& fitting);

/// The outline of the wanted parts' slices at two heights and between them, widened by the ease. Its radius
/// is 0 where there is no skin.
Outline ring_outline(const Fitting& fitting, double low, double high, const PartFilter& wanted,
                     const Point2& center);
/// The center of the slice's box.
Point2 slice_center(const Fitting& fitting, double y, const PartFilter& wanted);

/// Appends one ring of vertices at height y.
void add_ring(Cut& cut, const Outline& outline, double y, std::span<const double> angles);
/// Appends two triangles between four vertices in order around the quad; the diagonal alternates with `odd`.
void add_quad(Cut& cut, geometry::Index a, geometry::Index b, geometry::Index c, geometry::Index d, bool odd);
/// Joins consecutive rings of `columns` vertices, the first starting at vertex `first`.
void join_rings(Cut& cut, int rings, int columns, geometry::Index first = 0);

bool is_leg(body::Part part);

}  // namespace bodice::synth
