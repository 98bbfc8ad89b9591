#include <bodice/geometry/mesh_repair.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include <bodice/engine/catch_canceled.hpp>
#include <bodice/engine/message.hpp>
#include <bodice/geometry/fins.hpp>
#include <bodice/geometry/mesh_edges.hpp>

#include "repair/orient.hpp"
#include "repair/weld.hpp"

namespace bodice::inline v0_1::geometry {
namespace {

using engine::Error;
using engine::ErrorCode;

// Coordinates beyond this bound are treated like NaN, because their products leave the range of double.
constexpr double kLargestCoordinate = 1e75;
// A triangle lower than this fraction of the diagonal has no area. Rounding alone gives collinear corners a
// height of about 1e-16 of it.
constexpr double kFlatRelative = 1e-12;
// So many points ahead the bucket of one is fetched: buckets are all over the memory.
constexpr std::size_t kFetched = 8;

bool usable(const Vec3& p) {
  return p.allFinite() && p.cwiseAbs().maxCoeff() <= kLargestCoordinate;
}

struct Counts {
  std::size_t bad_vertices = 0, bad_triangles = 0, flat = 0, duplicate = 0, fins = 0;
};

class Repair {
 public:
  Repair(const TriMesh& input, const RepairOptions& options) : input_(input), options_(options) {}

  engine::Result<RepairedMesh> run(const engine::Context& context) {
    keep_usable();
    weld();
    context.cancel.check();
    drop_flat();
    drop_duplicates();
    if (kept_.empty())
      return Error{ErrorCode::kUnusableGeometry,
                   "No triangle is left of " + std::to_string(input_.triangles.size()) +
                       ": all have no area, no valid corners or no finite coordinates.",
                   "Check that the file holds a surface of triangles or polygons."};
    context.cancel.check();
    compact();
    MeshEdges edges = mesh_edges(out_.mesh);
    if (options_.drop_fins && drop_fins(edges)) edges = mesh_edges(out_.mesh);
    orient_and_count(edges);
    warn();
    return std::move(out_);
  }

 private:
  void keep_usable() {
    for (const Vec3& p : input_.positions) counts_.bad_vertices += !usable(p);
    for (Index t = 0; t < input_.triangles.size(); ++t) {
      const Triangle& corners = input_.triangles[t];
      const bool good = std::all_of(corners.begin(), corners.end(), [&](Index v) {
        return v < input_.positions.size() && usable(input_.positions[v]);
      });
      if (good)
        kept_.push_back(t);
      else
        ++counts_.bad_triangles;
    }
  }

  /// Fills representative_, numbered by first use, and welded_.
  void weld() {
    std::vector<Vec3> used;
    std::vector<Index> vertex;  // the input vertex of each used point
    std::vector<bool> seen(input_.positions.size(), false);
    for_each_corner([&](Index v) {
      if (seen[v]) return;
      seen[v] = true;
      used.push_back(input_.positions[v]);
      vertex.push_back(v);
    });
    diagonal_ = robust_diagonal(used);
    Welder welder(options_.weld_relative * diagonal_, used.size());
    representative_.assign(input_.positions.size(), kNoIndex);
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (i + kFetched < used.size()) welder.fetch(used[i + kFetched]);
      representative_[vertex[i]] = welder.add(used[i]);
    }
    positions_ = welder.representatives();
    out_.report.welded = used.size() - positions_.size();
    welded_.resize(input_.triangles.size());
    for (Index t : kept_)
      for (int k = 0; k < 3; ++k) welded_[t][k] = representative_[input_.triangles[t][k]];
  }

  template <class Visit>
  void for_each_corner(Visit&& visit) const {
    for (Index t : kept_)
      for (Index v : input_.triangles[t]) visit(v);
  }

  void drop_flat() {
    const double least_height = kFlatRelative * diagonal_;
    auto flat = [&](Index t) {
      const Vec3& a = positions_[welded_[t][0]];
      const Vec3 ab = positions_[welded_[t][1]] - a;
      const Vec3 ac = positions_[welded_[t][2]] - a;
      const double longest =
          std::sqrt(std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()}));
      return !(ab.cross(ac).norm() > least_height * longest);
    };
    counts_.flat = std::erase_if(kept_, flat);
  }

  /// Drops every triangle on the same three vertices as an earlier one, whatever its winding.
  void drop_duplicates() {
    struct Other {
      Index middle, high, triangle;  // the two higher corners
      auto operator<=>(const Other&) const = default;
    };
    std::vector<Index> offset(positions_.size() + 1, 0);  // triangles in groups of their lowest corner
    for (Index t : kept_) ++offset[*std::min_element(welded_[t].begin(), welded_[t].end()) + 1];
    std::partial_sum(offset.begin(), offset.end(), offset.begin());
    std::vector<Other> others(kept_.size());
    std::vector<Index> next(offset.begin(), offset.end() - 1);
    for (Index t : kept_) {
      Triangle sorted = welded_[t];
      std::sort(sorted.begin(), sorted.end());
      others[next[sorted[0]]++] = {sorted[1], sorted[2], t};
    }
    std::vector<bool> duplicate(input_.triangles.size(), false);
    for (std::size_t low = 0; low + 1 < offset.size(); ++low) {
      const std::span<Other> group(others.begin() + offset[low], others.begin() + offset[low + 1]);
      std::sort(group.begin(), group.end());
      for (std::size_t i = 1; i < group.size(); ++i)
        duplicate[group[i].triangle] =
            group[i].middle == group[i - 1].middle && group[i].high == group[i - 1].high;
    }
    counts_.duplicate = std::erase_if(kept_, [&](Index t) { return duplicate[t]; });
  }

  /// Drops the vertices that no kept triangle uses; the rest keep the order of their first use.
  void compact() {
    out_.mesh = {};
    out_.triangle_of_input.assign(input_.triangles.size(), kNoIndex);
    std::vector<Index> renumbered(positions_.size(), kNoIndex);
    for (Index t : kept_) {
      Triangle triangle = welded_[t];
      for (Index& v : triangle) {
        Index& to = renumbered[v];
        if (to == kNoIndex) {
          to = static_cast<Index>(out_.mesh.positions.size());
          out_.mesh.positions.push_back(positions_[v]);
        }
        v = to;
      }
      out_.triangle_of_input[t] = static_cast<Index>(out_.mesh.triangles.size());
      out_.mesh.triangles.push_back(triangle);
    }
    out_.vertex_of_input = representative_;
    for (Index& v : out_.vertex_of_input)
      if (v != kNoIndex) v = renumbered[v];
  }

  /// Drops fins and returns whether there were any. One pass is enough: what hangs on a fin is a fin.
  bool drop_fins(const MeshEdges& edges) {
    const std::vector<bool> fin = find_fins(out_.mesh, edges);
    counts_.fins = std::erase_if(kept_, [&](Index t) { return fin[out_.triangle_of_input[t]]; });
    if (counts_.fins > 0) compact();
    return counts_.fins > 0;
  }

  void orient_and_count(const MeshEdges& edges) {
    RepairReport& report = out_.report;
    report.dropped_vertices = static_cast<std::size_t>(
        std::count(out_.vertex_of_input.begin(), out_.vertex_of_input.end(), kNoIndex));
    report.dropped_triangles = input_.triangles.size() - out_.mesh.triangles.size();
    report.boundary_edges = edges.boundary;
    report.non_manifold_edges = edges.non_manifold;
    report.euler_characteristic = euler_characteristic(out_.mesh, edges);
    report.components = connected_components(out_.mesh).area.size();
    if (!options_.orient) return;
    const Orientation orientation = choose_orientation(out_.mesh, edges);
    for (std::size_t t = 0; t < out_.mesh.triangles.size(); ++t)
      if (orientation.flip[t]) std::swap(out_.mesh.triangles[t][1], out_.mesh.triangles[t][2]);
    report.flipped_triangles = orientation.flipped;
    conflicts_ = orientation.conflicts;
  }

  void warn() {
    auto add = [&](std::size_t count, const char* code, const char* what, const char* remedy) {
      if (count > 0) out_.report.warnings.push_back({code, "", std::to_string(count) + " " + what, remedy});
    };
    const auto note = [&](std::size_t count, const char* code, const char* what, const char* remedy) {
      add(count, code, what, remedy);
      if (count > 0) out_.report.warnings.back().note = true;
    };
    add(counts_.bad_vertices, "non-finite-vertices",
        "vertices have NaN, infinite or absurd coordinates and were dropped.",
        "Export the mesh again without them.");
    note(counts_.bad_triangles, "broken-triangles", "triangles were dropped with vertices they refer to.",
         "Export the mesh again; the skin may have holes there.");
    note(counts_.flat, "flat-triangles", "triangles without area were dropped.", "");
    note(counts_.duplicate, "duplicate-triangles", "triangles repeated another and were dropped.", "");
    note(counts_.fins, "fins", "triangles stuck out of the skin as fins and were dropped.", "");
    note(out_.report.flipped_triangles, "flipped-triangles", "triangles faced inward and were turned.", "");
    note(out_.report.boundary_edges, "open-edges",
         "edges have a triangle on one side only: the surface has holes.",
         "Close the holes for exact distances next to them.");
    note(out_.report.non_manifold_edges, "non-manifold-edges", "edges have three or more triangles.",
         "Remove inner faces.");
    add(conflicts_, "not-orientable", "edges join triangles that cannot be wound consistently.",
        "Separate the two sides of the surface there.");
  }

  const TriMesh& input_;
  const RepairOptions& options_;
  RepairedMesh out_;
  std::vector<Index> kept_;            // input triangles that are not dropped
  std::vector<Index> representative_;  // #input vertices: the vertex that each is welded to
  std::vector<Triangle> welded_;       // #input triangles: their corners' representatives
  std::vector<Vec3> positions_;        // positions of the representatives
  double diagonal_ = 0.0;
  Counts counts_;
  std::size_t conflicts_ = 0;
};

}  // namespace

engine::Result<RepairedMesh> repair(const engine::Context& context, const TriMesh& input,
                                    const RepairOptions& options) {
  if (!(options.weld_relative >= 0.0 && options.weld_relative < 1.0))
    return Error{ErrorCode::kInvalidArgument,
                 "The weld distance must be a fraction of the diagonal, in [0, 1).",
                 engine::message("Use ", kWeldRelative, ", or 0 to weld exact copies only.")};
  return engine::catch_canceled("The mesh repair", [&] { return Repair(input, options).run(context); });
}

}  // namespace bodice::geometry
