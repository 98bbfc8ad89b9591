// Props: things that stand still beside a body in a drape, and that its garments meet.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <bodice/fitting/fit.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bodice::inline v0_1::tryon {

/// Reads a thing in the unit, axes and coordinates of the body's file, and fits it as io::Shape::kAny at the
/// body's scale. Its tier is relief where the body's is, else tight. From `options` it uses the number of
/// ellipsoids, the target error and the time budget. Fails as segment_file() and fit_proxy() do.
engine::Result<PreparedBody> read_prop(const engine::Context& context, const std::filesystem::path& file,
                                       const PreparedBody& body, const fitting::FitOptions& options,
                                       const Progress& progress = {});

/// The same for a mesh in memory, in meters with y up, in the body's coordinates.
engine::Result<PreparedBody> make_prop(const engine::Context& context, const geometry::TriMesh& mesh,
                                       const PreparedBody& body, const fitting::FitOptions& options);

/// The body's proxy with those of the props as one proxy: proxy::add_things(). Fails as this does.
engine::Result<proxy::BodyProxy> with_props(const proxy::BodyProxy& body,
                                            std::span<const PreparedBody> props);

/// Cloth inside one prop, by the exact signed distance to its surface.
struct PropReport {
  std::string name;  ///< the file that the prop was read from
  std::size_t ellipsoids = 0;
  fitting::FitAccuracy accuracy;
  std::size_t over_1mm = 0;  ///< particles deeper than 1 mm at the last frame
  double deepest_m = 0.0;    ///< deepest particle of any frame
  double end_m = 0.0;        ///< deepest particle at the last frame
  int worst_frame = 0;
  double pierced_share = 0.0;  ///< share of the cloth's area inside the prop at the end
};

/// The reports of the props before the first frame.
std::vector<PropReport> describe(std::span<const PreparedBody> props);
/// Measures the depth of the particles (#P) in each prop after a frame, and updates the reports: the maximum,
/// and the values of the last frame.
void add_frame(const engine::Context& context, int frame, std::span<const geometry::Vec3> positions,
               std::span<const PreparedBody> props, std::vector<PropReport>& reports);
/// Sets PropReport::pierced_share of each prop.
void add_cloth(const engine::Context& context, std::span<const geometry::Vec3> positions,
               std::span<const geometry::Triangle> triangles, std::span<const PreparedBody> props,
               std::vector<PropReport>& reports);

}  // namespace bodice::tryon
