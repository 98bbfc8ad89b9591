// How a garment fits, as a color of each of its vertices.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/io/scene.hpp>

namespace bodice::inline v0_1::tryon {

/// The quantity that a map shows.
enum class FitMap {
  kEase,   ///< the distance from the cloth to the skin
  kStrain  ///< how much the cloth is stretched
};

/// The values at both ends of a map's colors: dark blue at the loose end, dark red at the tight one.
struct FitScale {
  FitMap map = FitMap::kEase;
  double loose = 0.0, tight = 0.0;  ///< meters, or shares of a length
};

/// The distance of each vertex (#V) to the skin, negative inside it. Positions that are not finite have none,
/// 0. Cost: an exact signed distance a vertex, a few microseconds.
std::vector<double> ease_of_vertices(const engine::Context& context, const geometry::MeshDistance& skin,
                                     std::span<const geometry::Vec3> now);

/// The strain of each vertex (#V): the elongation of the most stretched edge of a triangle, zero or more, the
/// mean over the vertex's triangles by area. `rest` is the garment as it was made. O(#V + #F).
std::vector<double> strain_of_vertices(const geometry::TriMesh& rest, std::span<const geometry::Vec3> now);

/// The color of each value, sRGB 0..1: dark blue, light blue, pale yellow, orange, dark red from loose to
/// tight, and the color of an end beyond it. They differ in lightness and hue, for color-blind people.
std::vector<std::array<float, 3>> fit_colors(std::span<const double> values, const FitScale& scale);

/// The colors from loose to tight for a picture: ease in millimeters, strain in percent.
io::Legend legend_of(const FitScale& scale);

}  // namespace bodice::tryon
