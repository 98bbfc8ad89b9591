// Skins from meshes and files.
#include "whole/skin.hpp"

#include <bodice/tryon/rigged_body.hpp>

#include "arrays/mesh.hpp"
#include "base/handles.hpp"
#include "base/structures.hpp"
#include "whole/rig.hpp"

using namespace bodice;
using capi::invalid;
using capi::Outcome;

bodice_skin::bodice_skin(capi::SharedContext shared, tryon::SegmentedSkin made)
    : context(std::move(shared)), skin(std::move(made)) {
  for (const engine::Warning& warning : skin.warnings) warnings.push_back(warning.sentence());
}

namespace bodice::inline v0_1::capi {
namespace {

constexpr double kLeastStature_m = 0.3, kMostStature_m = 3.0;

/// The shape of the options, of which there are two.
Outcome read_shape(const bodice_skin_options& options, io::Shape& out) {
  if (options.shape != BODICE_SHAPE_PERSON && options.shape != BODICE_SHAPE_ANY)
    return invalid("bodice_skin_options.shape is " + std::to_string(options.shape) + ".",
                   "Give BODICE_SHAPE_PERSON or BODICE_SHAPE_ANY.");
  out = options.shape == BODICE_SHAPE_ANY ? io::Shape::kAny : io::Shape::kPerson;
  return {};
}

/// Whether the coordinates can be meters; another unit would only show in cloth that behaves oddly.
Outcome check_size(const tryon::SegmentedSkin& skin) {
  if (skin.input.shape == io::Shape::kAny) return {};
  const double stature = skin.anatomy.stature_m;
  if (stature >= kLeastStature_m && stature <= kMostStature_m) return {};
  return invalid("The body is " + std::to_string(stature) + " high, and coordinates are meters.",
                 stature > 30.0 && stature < 300.0
                     ? "Multiply the coordinates by 0.01 if they are centimeters."
                     : "Scale the coordinates to meters.");
}

/// Gives the skin the rig of the host; its weights are those of input vertices.
Outcome attach(rig::Rig given, tryon::SegmentedSkin& skin) {
  given.weights = tryon::weights_of_skin(given.weights, skin.input);
  auto mended = rig::mend(given, skin.input.skin.positions.size());
  if (!mended) return mended.error();
  skin.warnings.insert(skin.warnings.end(), mended->begin(), mended->end());
  skin.rig = std::make_shared<const rig::Rig>(std::move(given));
  return {};
}

}  // namespace

Outcome read_body(const bodice_mesh* mesh, const bodice_skin_options& options, HostBody& out) {
  BODICE_CHECK(read_mesh(mesh, out.mesh));
  out.find_rig = options.find_rig != 0;
  BODICE_CHECK(read_shape(options, out.shape));
  if (!options.rig) return {};
  if (out.shape == io::Shape::kAny)
    return invalid("bodice_skin_options has a rig and BODICE_SHAPE_ANY.",
                   "Pass the rig with a person, or leave it null.");
  return read_rig(options.rig, out.mesh.positions.size(), out.rig.emplace());
}

Outcome make_skin(const engine::Context& context, Progress& progress, HostBody body,
                  tryon::SegmentedSkin& out) {
  progress.stage("repair");
  auto input = tryon::repair_body(context, body.mesh);
  if (!input) return input.error();
  input->shape = body.shape;
  progress.stage("segment");
  auto skin = tryon::segment_mesh(context, std::move(input).value(), {});
  if (!skin) return skin.error();
  BODICE_CHECK(check_size(*skin));
  if (body.rig) BODICE_CHECK(attach(std::move(*body.rig), *skin));
  if (body.find_rig) {
    progress.stage("rig");
    if (auto found = tryon::give_rig(context, io::ImportedMesh{}, *skin); !found) return found.error();
  }
  out = std::move(skin).value();
  return {};
}

}  // namespace bodice::capi

bodice_status bodice_skin_from_mesh(const bodice_context* context, const bodice_mesh* mesh,
                                    const bodice_skin_options* given, bodice_skin** out) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::begin_result(out, "the skin"));
    BODICE_CHECK(capi::check_handle(context, "The context"));
    bodice_skin_options options;
    BODICE_CHECK(capi::read(given, options, true));
    capi::HostBody body;
    BODICE_CHECK(capi::read_body(mesh, options, body));
    capi::Progress progress(context->state->engine_context(), options.progress, options.host);
    tryon::SegmentedSkin skin;
    BODICE_CHECK(capi::make_skin(progress.context(), progress, std::move(body), skin));
    *out = new bodice_skin(context->state, std::move(skin));
    return {};
  });
}

namespace {

/// Segments a body that brings its own bones, by `segment(context, options)`; `source` is where bones are
/// looked for.
template <class Segment>
Outcome make(const bodice_context* context, const bodice_skin_options* given, const tryon::BodySource& source,
             bodice_skin** out, Segment segment) {
  BODICE_CHECK(capi::check_handle(context, "The context"));
  bodice_skin_options options;
  BODICE_CHECK(capi::read(given, options, true));
  if (options.rig)
    return invalid("bodice_skin_options.rig is set for a body that is not a mesh of the program.",
                   "Leave it null: such a body brings its own bones.");
  tryon::SegmentOptions segment_options;
  BODICE_CHECK(capi::read_shape(options, segment_options.import.shape));
  capi::Progress progress(context->state->engine_context(), options.progress, options.host);
  progress.stage("segment");
  engine::Result<tryon::SegmentedSkin> skin = segment(progress.context(), segment_options);
  if (!skin) return skin.error();
  if (options.find_rig) {
    progress.stage("rig");
    if (auto found = tryon::give_rig(progress.context(), source, *skin); !found) return found.error();
  }
  *out = new bodice_skin(context->state, std::move(skin).value());
  return {};
}

}  // namespace

bodice_status bodice_skin_from_file(const bodice_context* context, const char* path,
                                    const bodice_skin_options* options, bodice_skin** out) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::begin_result(out, "the skin"));
    if (!path) return invalid("The path is null.", "Pass the name of a body file.");
    const std::filesystem::path file = std::u8string_view(reinterpret_cast<const char8_t*>(path));
    return make(context, options, tryon::BodyFile{file}, out,
                [&](const engine::Context& engine_context, const tryon::SegmentOptions& segment_options) {
                  return tryon::segment_file(engine_context, file, segment_options);
                });
  });
}

bodice_status bodice_skin_built_in(const bodice_context* context, int32_t female, double stature_m,
                                   const bodice_skin_options* options, bodice_skin** out) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::begin_result(out, "the skin"));
    if (!(stature_m >= 1.2 && stature_m <= 2.2))
      return invalid("The built-in body cannot be " + std::to_string(stature_m) + " m tall.",
                     "Give 1.2 to 2.2 meters.");
    const synth::BodyOptions body{.sex = female ? body::Sex::kFemale : body::Sex::kMale,
                                  .stature_m = stature_m};
    return make(context, options, body, out,
                [&](const engine::Context& engine_context, const tryon::SegmentOptions& segment_options) {
                  return tryon::segment_builtin(engine_context, body, segment_options);
                });
  });
}

void bodice_skin_destroy(bodice_skin* skin) {
  delete skin;
}
