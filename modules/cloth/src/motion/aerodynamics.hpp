// Air: drag and lift on each particle's share of the surface, and gusts.
#pragma once

#include <cstdint>
#include <vector>

#include <bodice/cloth/solver.hpp>

#include "base/particles.hpp"

namespace bodice::inline v0_1::cloth {

/// Each particle's share of the surface and the wind there, updated once a frame.
struct Air {
  std::vector<Triangle> triangles;            ///< #F x 3 particles
  std::vector<Index> corner_begin;            ///< #P + 1: offsets into corner_triangle
  std::vector<Index> corner_triangle;         ///< the triangles around each particle, ascending
  std::vector<float> tri_x, tri_y, tri_z;     ///< #F: a third of the area vector, square meters
  std::vector<float> nx, ny, nz;              ///< #P: unit normal, or zero
  std::vector<float> area_m2;                 ///< #P: a third of the triangles' areas
  std::vector<float> wind_x, wind_y, wind_z;  ///< #P: meters a second
};

/// The air around a garment, without wind yet.
Air make_air(const geometry::TriMesh& mesh);

/// Updates normals and wind for a frame. `time_s` is the simulated time; gusts are a pure function of seed,
/// time and point.
void update_air(const engine::Context& context, const Environment& environment, std::uint64_t seed,
                double time_s, const Particles& particles, Air& air);

/// Adds gravity and air over a substep to the velocities [begin, end). They are handled four at a time:
/// `begin` is a multiple of four, and the last four may extend beyond `end`. Stable for any wind and step,
/// because the relative velocity decays and never overshoots.
void accelerate(const Environment& environment, const Air& air, float substep_s, std::size_t begin,
                std::size_t end, Particles& particles);

}  // namespace bodice::cloth
