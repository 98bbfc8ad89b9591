// The four bodies of the paper's Table 2, as near as they can be had.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <bodice/engine/result.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace paper_bench {

/// A row of the paper's Table 2: its body, its counts, and its seconds on a Core i3-2350M.
struct PaperRow {
  const char* body;
  int vertices, ellipsoids;
  double theirs_segment_s, theirs_fit_s;  ///< the paper's [19]
  double ours_segment_s, ours_fit_s;      ///< the paper's method
};

inline constexpr PaperRow kTable2[] = {{"Male 1", 4508, 55, 0.8, 1.4, 0.5, 1.3},
                                       {"Female 1", 8650, 86, 0.8, 2.3, 1.1, 1.8},
                                       {"Male 2", 8750, 88, 2.4, 2.5, 1.7, 2.5},
                                       {"Female 2", 8850, 89, 1.1, 2.6, 0.8, 2.3}};

/// A body of this bench that takes the role of one of the paper's.
struct Subject {
  PaperRow paper;
  std::string source;  ///< "synth", or the file's name
  bodice::geometry::TriMesh mesh;
};

/// The four bodies, in the order of kTable2. They come from `data`/counts if that folder is given, else synth
/// makes them with vertex counts within a few percent of the paper's.
bodice::engine::Result<std::vector<Subject>> four_bodies(const std::filesystem::path& data);

}  // namespace paper_bench
