// Air: drag and lift of each particle's share of the surface, and gusts.
#pragma once

#include <cstdint>
#include <vector>

#include <bodice/cloth/solver.hpp>

#include "base/particles.hpp"

namespace bodice::cloth {

/// The surface's share of each particle and the wind there, kept for a frame. #P each.
struct Air {
  std::vector<Triangle> triangles;            ///< of particles
  std::vector<Index> corner_begin;            ///< #P + 1, offsets into corner_triangle
  std::vector<Index> corner_triangle;         ///< triangles around each particle, ascending
  std::vector<float> tri_x, tri_y, tri_z;     ///< #F, a third of the area vector, square meters
  std::vector<float> nx, ny, nz;              ///< unit normal, or zero
  std::vector<float> area_m2;                 ///< a third of the triangles' areas
  std::vector<float> wind_x, wind_y, wind_z;  ///< meters a second
};

Air make_air(const geometry::TriMesh& mesh);

/// Normals and wind of this frame. `time_s` is simulated time; gusts are a pure function of seed, time and
/// place.
void update_air(const engine::Context& context, const Environment& environment, std::uint64_t seed,
                double time_s, const Particles& particles, Air& air);

/// Adds gravity and air to the velocities [begin, end) over a substep, four at a time: begin is a multiple of
/// four, the last four may reach beyond end. Stable for any wind and step: the
/// relative velocity decays, it never overshoots.
void accelerate(const Environment& environment, const Air& air, float substep_s, std::size_t begin,
                std::size_t end, Particles& particles);

}  // namespace bodice::cloth
