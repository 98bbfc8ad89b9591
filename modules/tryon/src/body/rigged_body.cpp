#include <bodice/tryon/rigged_body.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include <bodice/engine/message.hpp>
#include <bodice/engine/stage_timer.hpp>
#include <bodice/io/rig.hpp>
#include <bodice/rig/retarget.hpp>
#include <bodice/rigging/clear_arms.hpp>
#include <bodice/rigging/make_rig.hpp>
#include <bodice/rigging/motion.hpp>

#include "body/append.hpp"
#include "body/load_body.hpp"

namespace bodice::inline v0_1::tryon {
namespace {

engine::Result<rig::Rig> rig_of(const engine::Context& context, const synth::BodyOptions& builtin,
                                const io::ImportedMesh& skin) {
  auto made = synth::make_body(context, builtin);
  if (!made) return std::move(made).error();
  return rig::Rig{std::move(made->skeleton), weights_of_skin(made->weights, skin), {}};
}

bool same_joints(const rig::Skeleton& a, const rig::Skeleton& b) {
  return std::ranges::equal(a.joints, b.joints, [](const rig::Joint& x, const rig::Joint& y) {
    return x.name == y.name && x.parent == y.parent;
  });
}

/// Retargets a clip of another skeleton to this rig. A warning counts the joints that have no partner.
engine::Result<BodyMotion> retargeted(const rig::Skeleton& source, const rig::Clip& clip, const rig::Rig& rig,
                                      std::vector<engine::Warning>& warnings) {
  auto carried = rig::retarget(source, clip, rig.skeleton);
  if (!carried) return std::move(carried).error();
  const rig::RetargetReport& report = carried->report;
  if (!report.unmatched_source.empty())
    warnings.push_back({"motion-joints", report.unmatched_source.front(),
                        engine::message("The clip '", clip.name, "' is of another skeleton: ",
                                        report.matched.size(), " joints follow it, ",
                                        report.unmatched_source.size(), " of its joints are missing here."),
                        "Give a clip of this body's own skeleton for all of its motion."});
  return BodyMotion{rig, std::move(carried->clip), 0.0};
}

/// The options of a made motion for a skin. The floor is the lowest point of the skin, because a scan may sit
/// on it with heels or toes up. Wide bodies hold their arms out, which would otherwise swing through the hips
/// and the cloth on them.
rigging::MotionOptions motion_options(const SegmentedSkin& skin, const rig::Rig& rig,
                                      std::optional<double> arms_out_before_deg) {
  const geometry::TriMesh& mesh = skin.input.skin;
  const std::vector<body::Part>& part = skin.anatomy.part;
  return {.arms_out_deg = arms_out_before_deg
                              ? rigging::keep_arms_clear_deg(mesh, part, rig, *arms_out_before_deg)
                              : rigging::clear_arms_deg(mesh, part, rig),
          .floor_m = geometry::bounding_box(skin.input.skin.positions).low.y()};
}

/// Made motions need the common skeleton. For another rig, a common skeleton of the same body is found, and
/// its clip is retargeted.
engine::Result<BodyMotion> made_motion(const engine::Context& context, const SegmentedSkin& skin,
                                       rigging::Motion motion, std::optional<double> arms_out_before_deg,
                                       std::vector<engine::Warning>& warnings) {
  rigging::MotionOptions options = motion_options(skin, *skin.rig, arms_out_before_deg);
  if (auto clip = rigging::make_clip(skin.rig->skeleton, motion, options))
    return BodyMotion{*skin.rig, std::move(clip).value(), options.arms_out_deg};
  auto common = rigging::make_rig(context, skin.input.skin, skin.anatomy);
  if (!common) return with_body_name(std::move(common).error(), skin.input);
  options = motion_options(skin, common->rig, arms_out_before_deg);
  auto clip = rigging::make_clip(common->rig.skeleton, motion, options);
  if (!clip) return std::move(clip).error();
  auto carried = retargeted(common->rig.skeleton, *clip, *skin.rig, warnings);
  if (carried) carried->arms_out_deg = options.arms_out_deg;
  return carried;
}

}  // namespace

rig::SkinWeights weights_of_skin(const rig::SkinWeights& input, const io::ImportedMesh& body) {
  std::vector<geometry::Index> input_of(body.skin.positions.size(), geometry::kNoIndex);
  for (std::size_t i = 0; i < body.vertex_of_input.size(); ++i) {
    const geometry::Index v = body.vertex_of_input[i];
    if (v != geometry::kNoIndex && input_of[v] == geometry::kNoIndex)
      input_of[v] = static_cast<geometry::Index>(i);
  }
  rig::SkinWeights weights;
  weights.first.push_back(0);
  for (const geometry::Index i : input_of) {
    for (std::uint32_t e = input.first[i]; e < input.first[i + 1]; ++e) {
      weights.joint.push_back(input.joint[e]);
      weights.weight.push_back(input.weight[e]);
    }
    weights.first.push_back(static_cast<std::uint32_t>(weights.joint.size()));
  }
  return weights;
}

engine::Result<void> give_rig(const engine::Context& context, const BodySource& source, SegmentedSkin& skin) {
  if (skin.rig) return {};
  const engine::StageTimer timer(context, skin.stages, "rig");
  if (const auto* builtin = std::get_if<synth::BodyOptions>(&source)) {
    auto rig = rig_of(context, *builtin, skin.input);
    if (!rig) return std::move(rig).error();
    skin.rig = std::make_shared<const rig::Rig>(std::move(rig).value());
    return {};
  }
  if (skin.input.shape == io::Shape::kAny)
    return with_body_name(
        {engine::ErrorCode::kInvalidArgument, "A thing without bones has no joints to find.",
         "Give a file with a skeleton, or read it as a person."},
        skin.input);
  auto found = rigging::make_rig(context, skin.input.skin, skin.anatomy);
  if (!found) return with_body_name(std::move(found).error(), skin.input);
  skin.rig = std::make_shared<const rig::Rig>(std::move(found->rig));
  return {};
}

namespace {

/// Whether the text is a name rather than a path: no folder, no extension.
bool is_bare_word(std::string_view text) {
  return text.find_first_of("/\\.") == std::string_view::npos;
}

engine::Error no_motion(std::string_view name) {
  std::string names;
  for (const std::string_view motion : rigging::kMotionNames)
    names += (names.empty() ? "" : ", ") + std::string(motion);
  return {engine::ErrorCode::kNotFound,
          engine::message("There is neither a motion '", name, "' nor a file of that name."),
          "Made here are " + names + "; else name a GLB, FBX, DAE or BVH file."};
}

}  // namespace

engine::Result<rig::Clip> choose_clip(const MotionChoice& choice, const std::vector<rig::Clip>& clips) {
  if (choice.clip.empty() && !clips.empty()) return clips.front();
  std::string names;
  for (const rig::Clip& clip : clips) {
    if (clip.name == choice.clip) return clip;
    names += (names.empty() ? "'" : ", '") + clip.name + "'";
  }
  return engine::Error{engine::ErrorCode::kInvalidArgument,
                       engine::message(choice.motion, ": there is no clip '", choice.clip, "'."),
                       clips.empty() ? "The file has no clips." : "Its clips are " + names + "."};
}

engine::Result<void> check_time(const rig::Clip& clip, double time_s) {
  constexpr double kRounding = 1e-6;
  if (time_s >= 0.0 && time_s <= clip.duration_s * (1.0 + kRounding)) return {};
  return engine::Error{engine::ErrorCode::kInvalidArgument,
                       engine::message("The clip '", clip.name, "' takes ", clip.duration_s,
                                       " s: it has no pose at ", time_s, " s."),
                       engine::message("Give seconds from 0 to ", clip.duration_s, ".")};
}

engine::Result<BodyMotion> find_motion(const engine::Context& context, const SegmentedSkin& skin,
                                       const MotionChoice& choice, std::vector<engine::Warning>& warnings) {
  if (const auto motion = rigging::motion_from_name(choice.motion)) {
    if (choice.clip.empty() || choice.clip == choice.motion)
      return made_motion(context, skin, *motion, {}, warnings);
    return engine::Error{
        engine::ErrorCode::kInvalidArgument,
        engine::message("The motion '", choice.motion, "' is made here and has no clip '", choice.clip, "'."),
        "Leave the clip out, or name a file that has it."};
  }
  auto read = io::import_motion(context, choice.motion);
  if (!read && is_bare_word(choice.motion)) return no_motion(choice.motion);
  if (!read) return std::move(read).error();
  append(warnings, read->warnings);
  auto clip = choose_clip(choice, read->clips);
  if (!clip) return std::move(clip).error();
  if (same_joints(read->skeleton, skin.rig->skeleton))
    return BodyMotion{*skin.rig, std::move(clip).value(), 0.0};
  return retargeted(read->skeleton, *clip, *skin.rig, warnings);
}

engine::Result<BodyMotion> motion_of_shape(const engine::Context& context, const SegmentedSkin& skin,
                                           const MotionChoice& choice, const BodyMotion& before) {
  const auto motion = rigging::motion_from_name(choice.motion);
  if (!motion) return BodyMotion{*skin.rig, before.clip, before.arms_out_deg};
  std::vector<engine::Warning> warnings;  // dropped, because the first shape gave the same ones
  return made_motion(context, skin, *motion, before.arms_out_deg, warnings);
}

}  // namespace bodice::tryon
