#include <bodice/synth/body.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

#include <bodice/engine/catch_canceled.hpp>
#include <bodice/engine/message.hpp>

#include "pose/deform.hpp"
#include "pose/rig.hpp"
#include "pose/tailor_truth.hpp"
#include "pose/truth.hpp"

namespace bodice::inline v0_1::synth {
namespace {

constexpr double kDensity = 1010.0;   // kg per cubic meter of a living body
constexpr int kLeastVertices = 1350;  // that of the cage itself, less ten percent
constexpr int kMostVertices = 4'000'000;
constexpr int kGirthRounds = 8;
constexpr int kRelaxations = 5;  // iterations a round, enough to follow a slow change of girth
constexpr double kVolumeTolerance = 0.01;

std::optional<engine::Error> check(const BodyOptions& o) {
  const auto wrong = [](std::string message, std::string remedy) {
    return engine::Error{engine::ErrorCode::kInvalidArgument, std::move(message), std::move(remedy)};
  };
  if (!(o.stature_m >= 0.4 && o.stature_m <= 2.6))
    return wrong(engine::message("A stature of ", o.stature_m, " m is not a human's."), "Give 0.4 to 2.6 m.");
  const double bmi = o.mass_kg / (o.stature_m * o.stature_m);
  if (!(bmi >= 10.0 && bmi <= 70.0))
    return wrong(engine::message(o.mass_kg, " kg at ", o.stature_m, " m is a body mass index of ", bmi, "."),
                 "Give a mass with an index between 10 and 70.");
  if (!(o.childhood >= 0.0 && o.childhood <= 1.0))
    return wrong(engine::message("A childhood of ", o.childhood, " is not in [0, 1]."),
                 "Give 0 (adult) to 1.");
  if (o.vertices < kLeastVertices || o.vertices > kMostVertices)
    return wrong(engine::message("A body of ", o.vertices, " vertices cannot be made."),
                 engine::message("Give ", kLeastVertices, " to ", kMostVertices, "."));
  return std::nullopt;
}

/// Changes the girths of the figure until its skin encloses the wanted volume (cubic statures).
Skin solve_girth(const engine::Context& context, Figure& figure, double wanted) {
  double low = -1.0, high = 6.0;
  Skin skin = make_skin(context, figure, Flesh(figure));
  double fat = figure.fat, slope = 0.0, last_fat = 0.0, last_volume = 0.0;
  for (int round = 0; round < kGirthRounds; ++round) {
    const double now = volume(skin.mesh, skin.positions);
    if (std::abs(now / wanted - 1.0) < kVolumeTolerance) break;
    (now < wanted ? low : high) = fat;
    slope = round == 0 ? now : (now - last_volume) / (fat - last_fat);
    last_fat = fat;
    last_volume = now;
    double next = slope > 0.0 ? fat + (wanted - now) / slope : 0.5 * (low + high);
    if (next <= low || next >= high) next = 0.5 * (low + high);
    fat = next;
    figure.fat = fat;
    settle(context, Flesh(figure), skin, kRelaxations);
  }
  return skin;
}

std::vector<geometry::Triangle> triangulate(const PatchMesh& mesh, const std::vector<Vec3>& positions) {
  std::vector<geometry::Triangle> triangles;
  triangles.reserve(2 * mesh.quads.size());
  for (const auto& q : mesh.quads) {
    const double ac = (positions[q[0]] - positions[q[2]]).squaredNorm();
    const double bd = (positions[q[1]] - positions[q[3]]).squaredNorm();
    if (ac <= bd) {
      triangles.push_back({q[0], q[1], q[2]});
      triangles.push_back({q[0], q[2], q[3]});
    } else {
      triangles.push_back({q[0], q[1], q[3]});
      triangles.push_back({q[1], q[2], q[3]});
    }
  }
  return triangles;
}

/// Scales the body to meters, with its lowest vertex on the floor and the pelvis above the origin.
void scale_and_stand(Body& body, double stature_m) {
  double floor = 1e9;
  for (const Vec3& p : body.mesh.positions) floor = std::min(floor, p.y());
  const Vec3 pelvis = body.joints[index(Bone::kPelvis)].position;
  const Vec3 origin(pelvis.x(), floor, pelvis.z());
  for (Vec3& p : body.mesh.positions) p = stature_m * (p - origin);
  for (Joint& joint : body.joints) joint.position = stature_m * (joint.position - origin);
  for (body::Landmark& mark : body.landmarks) mark.position = stature_m * (mark.position - origin);
  for (int i = 0; i < body::kMeasurementCount; ++i)
    if (!is_angle(static_cast<body::MeasurementId>(i))) body.measurements.value[i] *= stature_m;
}

Body make(const engine::Context& context, const BodyOptions& options, const body::Proportions& proportions) {
  Figure figure = make_figure(options, proportions);
  const double h = options.stature_m;
  const double wanted = options.mass_kg / kDensity / (h * h * h);
  Skin skin = solve_girth(context, figure, wanted);
  const Patches patches(skin.cage);
  const std::vector<Vec3> corners(
      skin.positions.begin(),
      skin.positions.begin() + static_cast<std::ptrdiff_t>(skin.cage.positions.size()));
  const PatchMesh mesh =
      patches.tessellate(counts_for_vertices(patches, patches.class_lengths(corners), options.vertices));
  std::vector<Vec3> rest = sample_skin(context, skin, Flesh(figure), mesh);
  // In folds, this sampling encloses more than the coarse skin did; a second correction makes up for it.
  const double enclosed = volume(mesh, rest);
  if (std::abs(enclosed / wanted - 1.0) > 2.0 * kVolumeTolerance) {
    skin = solve_girth(context, figure, wanted * volume(skin.mesh, skin.positions) / enclosed);
    rest = sample_skin(context, skin, Flesh(figure), mesh);
  }
  const std::vector<BoneWeights> of_skin = bone_weights(figure, skin);
  std::vector<BoneWeights> weights(rest.size());
  for (std::size_t v = 0; v < rest.size(); ++v) weights[v] = sample(skin.mesh, of_skin, mesh.at[v]);
  const BoneTransforms bones = pose_figure(figure, options.pose, options.seed);

  Body body;
  body.stature_m = h;
  body.mesh.positions = deform(context, rest, weights, bones);
  body.mesh.triangles = triangulate(mesh, rest);
  const Posed posed{figure, mesh, body.mesh.triangles, rest, weights, body.mesh.positions, bones};
  body.part = true_parts(posed);
  body.landmarks = true_landmarks(posed);
  body.measurements = true_measurements(posed, body.landmarks);
  body.joints = true_joints(figure, bones);
  scale_and_stand(body, h);
  body.skeleton = true_skeleton(bones, body.joints);
  body.weights = sparse_weights(weights);
  return body;
}

}  // namespace

engine::Result<Body> make_body(const engine::Context& context, const BodyOptions& options) {
  if (const auto error = check(options)) return *error;
  const auto profile = options.profile ? engine::Result<body::ProportionProfile>(*options.profile)
                                       : body::find_profile("ansur2");
  if (!profile) return profile.error();
  return engine::catch_canceled("The making of the body", [&]() -> engine::Result<Body> {
    return make(context, options, profile.value().of(options.sex));
  });
}

}  // namespace bodice::synth
