// Whole drapes.
#include <bodice/tryon/drape.hpp>
#include <bodice/tryon/place_garment.hpp>
#include <bodice/tryon/rigged_body.hpp>
#include <bodice/tryon/wearing.hpp>

#include "base/handles.hpp"
#include "base/structures.hpp"
#include "frame/proxy.hpp"
#include "whole/garments.hpp"
#include "whole/skin.hpp"

using namespace bodice;
using capi::invalid;
using capi::Outcome;

namespace {

Outcome read_options(const bodice_drape_options& given, tryon::DrapeOptions& out) {
  if (given.frames < 1 || given.substeps < 1 || given.substeps > cloth::kMaxSubsteps)
    return invalid("bodice_drape_options has " + std::to_string(given.frames) + " frames of " +
                       std::to_string(given.substeps) + " substeps.",
                   "Give 1 or more frames, and 1 to 128 substeps.");
  if (!(given.thickness_m >= 0.0 && given.thickness_m <= 0.1))
    return invalid("bodice_drape_options.thickness_m is " + std::to_string(given.thickness_m) + ".",
                   "Give 0 to 0.1 meters; 0 finds it.");
  if (!(given.tack_m >= 0.0 && given.tack_m <= 0.1))
    return invalid("bodice_drape_options.tack_m is " + std::to_string(given.tack_m) + ".",
                   "Give 0 to 0.1 meters; 0 tacks nothing.");
  BODICE_CHECK(capi::read_fabric(given.fabric, out.fabric));
  out.tack_m = given.tack_m;
  out.frames = given.frames;
  out.kept_frames = 2;
  out.dt_s = given.dt_s;
  out.solver.substeps = given.substeps;
  if (given.thickness_m > 0.0) out.thickness_m = given.thickness_m;
  return {};
}

static_assert(tryon::kTackWithin_m == 0.006, "the default of bodice_drape_options.tack_m states it");

bodice_drape_report as_c(const tryon::DrapeReport& from) {
  auto report = capi::with_defaults<bodice_drape_report>();
  report.hash = from.hash;
  report.penetration_over_1mm = from.penetration_over_1mm;
  report.penetration_end_m = from.penetration_end_m;
  report.penetration_max_m = from.penetration_max_m;
  report.stretch_p95 = from.stretch_p95;
  report.thickness_m = from.thickness_m;
  report.frame_ms = from.frame_ms_median;
  return report;
}

/// Puts garments on the body as the options ask for; what was changed goes to the log.
Outcome wear(const engine::Context& context, const tryon::SegmentedSkin& skin,
             const bodice_drape_options& options, std::vector<tryon::WornGarment>& worn) {
  for (tryon::WornGarment& garment : worn) {
    if (options.find_position) {
      auto placed = tryon::place_garment(context, {*skin.distance, skin.input.skin, skin.anatomy.stature_m},
                                         garment.name, garment.mesh);
      if (!placed) return placed.error();
      if (*placed) context.warn((*placed)->message + " " + (*placed)->remedy);
    }
    if (options.hold && garment.held.empty()) garment.held = tryon::held_vertices(garment.mesh, skin);
  }
  return {};
}

/// The last kept positions of all garments, garment after garment.
void write_end(const std::vector<io::GarmentTrack>& garments, const capi::StridedVectors& to) {
  std::size_t v = 0;
  for (const io::GarmentTrack& garment : garments)
    for (const geometry::Vec3& p : garment.frames.back()) to.set(v++, {p.x(), p.y(), p.z()});
}

/// Finds a motion by its name for a body and a proxy that follow the same rig.
Outcome find_motion(capi::Progress& progress, const tryon::PreparedBody& body, const char* name,
                    tryon::BodyMotion& to) {
  if (!body.skin.rig || !body.fit.proxy.binding())
    return invalid("The body has no rig that its proxy is bound to.",
                   "Make the skin with a rig or with find_rig, and fit it with bind.");
  progress.stage("motion");
  std::vector<engine::Warning> warnings;
  auto found = tryon::find_motion(progress.context(), body.skin, {.motion = name, .clip = {}}, warnings);
  if (!found) return found.error();
  to = std::move(found).value();
  return {};
}

}  // namespace

bodice_status bodice_drape(const bodice_context* context, const bodice_skin* skin, const bodice_proxy* proxy,
                           const bodice_garment* garments, size_t count, const bodice_drape_options* given,
                           const bodice_vectors* positions, bodice_drape_report* report) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(context, "The context"));
    BODICE_CHECK(capi::check_handle(skin, "The skin"));
    BODICE_CHECK(capi::check_handle(proxy, "The proxy"));
    bodice_drape_options options;
    BODICE_CHECK(capi::read(given, options, true));
    tryon::DrapeOptions wanted;
    BODICE_CHECK(read_options(options, wanted));
    std::vector<tryon::WornGarment> worn;
    BODICE_CHECK(capi::read_garments(garments, count, worn));
    std::size_t vertices = 0;
    for (const tryon::WornGarment& garment : worn) vertices += garment.mesh.positions.size();
    capi::StridedVectors to;
    if (positions) BODICE_CHECK(capi::read_positions(positions, vertices, to));
    BODICE_CHECK(capi::write(capi::with_defaults<bodice_drape_report>(), report, true));

    capi::Progress progress(context->state->engine_context(), options.progress, options.host);
    const tryon::PreparedBody body{.skin = skin->skin, .fit = {.proxy = proxy->proxy}};
    std::optional<tryon::BodyMotion> motion;
    if (options.motion) {
      BODICE_CHECK(find_motion(progress, body, options.motion, motion.emplace()));
      wanted.motion = &*motion;
    }
    progress.stage("drape");
    BODICE_CHECK(wear(progress.context(), body.skin, options, worn));
    auto draped = tryon::drape(progress.context(), body, worn, wanted);
    if (!draped) return draped.error();
    for (const engine::Warning& warning : draped->report.warnings)
      progress.context().warn(warning.sentence());
    if (to) write_end(draped->garments, to);
    return capi::write(as_c(draped->report), report, true);
  });
}
