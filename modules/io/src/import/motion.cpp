#include <algorithm>
#include <array>
#include <cmath>

#include <bodice/engine/message.hpp>
#include <bodice/io/rig.hpp>
#include <bodice/rig/retarget.hpp>

#include "import/body/body_frame.hpp"
#include "import/rig/build_skeleton.hpp"
#include "import/scene/bvh.hpp"
#include "import/scene/file_scene.hpp"
#include "import/source/file_format.hpp"

namespace bodice::inline v0_1::io {

namespace {

using geometry::Axis;
using geometry::Vec3;

/// Length of a skeleton along its longest side, meters: children to tall adults with their arms out.
constexpr double kShortest_m = 0.9, kLongest_m = 2.6;
/// What a skeleton of unknown unit is scaled to.
constexpr double kTypical_m = 1.65;
/// Units that motion files come in.
constexpr std::array kUnits_m = {1.0, 0.01, 0.001, 0.0254, 0.1};

struct Rest {
  std::vector<Vec3> position;  ///< #joints
  geometry::Box box;
};

Rest rest_of(const rig::Skeleton& skeleton) {
  std::vector<rig::Affine> world(skeleton.joints.size());
  rest_matrices(skeleton, world);
  Rest rest;
  for (const rig::Affine& map : world) {
    rest.position.push_back(map.col(3));
    rest.box.extend(rest.position.back());
  }
  return rest;
}

/// The axis that leads from the hips to the head, y where the names do not show it.
Axis up_of(const rig::Skeleton& skeleton, const Rest& rest) {
  std::optional<Vec3> hips, head;
  for (std::size_t j = 0; j < rest.position.size(); ++j) {
    const std::string name = rig::common_joint_name(skeleton.joints[j].name);
    if (name == "hips" && !hips) hips = rest.position[j];
    if (name == "head" && !head) head = rest.position[j];
  }
  if (!hips || !head) return Axis::kY;
  Eigen::Index axis = 1;
  (*head - *hips).cwiseAbs().maxCoeff(&axis);
  return static_cast<Axis>(axis);
}

/// The stated unit while it gives a person's size, else the first common unit that does.
geometry::Frame frame_of(const FileScene& scene, const rig::Skeleton& skeleton, ImportedMotion& out) {
  const Rest rest = rest_of(skeleton);
  const double length = rest.box.size().maxCoeff();
  geometry::Frame frame;
  frame.up = scene.up ? *scene.up : up_of(skeleton, rest);
  const auto fits = [&](double unit) { return unit * length >= kShortest_m && unit * length <= kLongest_m; };
  const auto found = std::find_if(kUnits_m.begin(), kUnits_m.end(), fits);
  if (scene.meters_per_unit && fits(*scene.meters_per_unit)) {
    frame.meters_per_unit = *scene.meters_per_unit;
  } else if (found != kUnits_m.end()) {
    frame.meters_per_unit = *found;
  } else {
    frame.meters_per_unit = length > 0.0 && std::isfinite(length) ? kTypical_m / length : 1.0;
    out.warnings.push_back({"unit-unknown", "",
                            engine::message("No common unit makes the skeleton, ", length,
                                            " units long, a person's size; it was scaled to ",
                                            frame.meters_per_unit * length, " m."),
                            "Retarget the clip, which scales it to the body."});
    out.unit = "unknown";
    return frame;
  }
  out.unit = unit_name(frame.meters_per_unit);
  return frame;
}

engine::Result<FileScene> read_any(const std::filesystem::path& file) {
  const Format format = format_of(file);
  const bool named_bvh =
      format == Format::kUnknown && file.extension() == ".bvh";  // its reader states the line
  if (format != Format::kBvh && !named_bvh) return read_motion_scene(file);
  auto rig = read_bvh(file);
  if (!rig) return rig.error();
  FileScene scene;
  scene.rig = std::move(*rig);
  return scene;
}

}  // namespace

engine::Result<ImportedMotion> import_motion(const engine::Context& context,
                                             const std::filesystem::path& file) {
  ImportedMotion out;
  out.file = file;
  context.checkpoint();
  auto scene = read_any(file);
  if (!scene) return scene.error();
  if (scene->rig.clips.empty())
    return engine::Error{engine::ErrorCode::kUnusableGeometry, "'" + file.string() + "' holds no clip.",
                         "Export it with its animation, or name a file that has one."};
  const std::vector<bool> used(scene->rig.bindings.size(), true);
  auto built = build_skeleton(scene->rig, used, {});
  if (built && !built->skeleton.joints.empty())
    built = build_skeleton(scene->rig, used, frame_of(*scene, built->skeleton, out));
  if (!built)
    return engine::Error{built.error().code, "'" + file.string() + "': " + built.error().message,
                         built.error().remedy};
  out.skeleton = std::move(built->skeleton);
  out.clips = std::move(built->clips);
  out.warnings.insert(out.warnings.end(), built->warnings.begin(), built->warnings.end());
  if (out.clips.empty())
    return engine::Error{engine::ErrorCode::kUnusableGeometry,
                         out.warnings.empty() ? "'" + file.string() + "' has no clip that moves a joint."
                                              : "'" + file.string() + "': " + out.warnings.back().message,
                         "Mend the clip and export it again."};
  return out;
}

}  // namespace bodice::io
