#include "fit_joint_offsets.hpp"

#include <cstdio>

#include <bodice/body/proportions.hpp>
#include <bodice/engine/executor.hpp>
#include <bodice/engine/parallel.hpp>

#include "joints/offset_joints.hpp"
#include "least_squares.hpp"

namespace calibrate {
namespace {

using bodice::body::JointId;
using bodice::body::of_side;
using bodice::rigging::BorderRings;
using bodice::rigging::FoundJoints;
using bodice::rigging::kOffsetJoints;
using bodice::rigging::OffsetFrame;
using bodice::rigging::SkinCurves;

/// The ridges that are tried, a cost of a squared offset each: a limb and the trunk that carries it are
/// nearly parallel in some bodies.
constexpr std::array kOffsetRidges{1e-9, 1e-8, 1e-7, 1e-6, 1e-5};

/// A true joint in an offset frame.
struct OffsetRow {
  std::size_t joint = 0;  ///< position in kOffsetJoints
  OffsetFrame frame;
  bodice::geometry::Vec3 truth;
};

bool has_pair(JointId joint) {
  return joint >= JointId::kClavicleL;
}

/// The name of the member of the file: that of a joint without its side.
std::string member(JointId joint) {
  const std::string name(bodice::body::name(joint));
  return has_pair(joint) ? name.substr(0, name.size() - 2) : name;
}

/// The frames of all joints of known truth. Empty where the body has no usable curves.
std::vector<OffsetRow> rows_of(const Sample& sample) {
  const auto& skin = sample.skin().mesh;
  const auto anatomy = bodice::anatomy::analyze({}, skin, {*bodice::body::find_profile("ansur2")});
  if (!anatomy) return {};
  const SkinCurves curves({}, skin, *anatomy);
  const auto rings = bodice::rigging::find_border_rings(curves);
  if (!rings) return {};
  FoundJoints joints;
  bodice::rigging::find_trunk(curves, *rings, joints);
  // A clavicle lies between neck and shoulder. Their true positions are used, so that errors of the found
  // ones do not enter its offsets.
  for (const JointId id : {JointId::kNeck, JointId::kUpperArmL, JointId::kUpperArmR})
    if (const auto truth = sample.skeleton_joint(id)) joints.at(id) = *truth;
  std::vector<OffsetRow> rows;
  for (std::size_t j = 0; j < std::size(kOffsetJoints); ++j)
    for (int side = 0; side < (has_pair(kOffsetJoints[j]) ? 2 : 1); ++side) {
      const JointId joint = has_pair(kOffsetJoints[j]) ? of_side(kOffsetJoints[j], side) : kOffsetJoints[j];
      if (const auto truth = sample.skeleton_joint(joint))
        rows.push_back({j, offset_frame(joint, curves, *rings, joints), *truth});
    }
  return rows;
}

/// The rows of all samples, found side by side.
std::vector<std::vector<OffsetRow>> rows_of(const Samples& samples) {
  std::vector<std::vector<OffsetRow>> rows(samples.size());
  const auto workers = bodice::engine::make_tbb_executor();
  const bodice::engine::Context context{.executor = workers.get()};
  bodice::engine::parallel_for(context, samples.size(), 1, [&](std::size_t i, std::size_t) {
    // A sample that counts several times stands in a row, and is analyzed once.
    if (i == 0 || samples[i - 1] != samples[i]) rows[i] = rows_of(*samples[i]);
  });
  for (std::size_t i = 1; i < samples.size(); ++i)
    if (samples[i - 1] == samples[i]) rows[i] = rows[i - 1];
  return rows;
}

}  // namespace

ordered_json fit_joint_offsets(const Samples& samples) {
  const auto rows = rows_of(samples);
  ordered_json out;
  for (std::size_t j = 0; j < std::size(kOffsetJoints); ++j) {
    const JointId joint = kOffsetJoints[j];
    FoldedLeastSquares system(static_cast<int>(bodice::rigging::measured_offsets(joint).size()));
    for (std::size_t i = 0; i < samples.size(); ++i)
      for (const OffsetRow& row : rows[i]) {
        if (row.joint != j) continue;
        const double stature_m = samples[i]->stature_m();
        for (int axis = 0; axis < 3; ++axis)
          system.add(samples[i]->person(), row.frame.axes.row(axis).transpose() / stature_m,
                     (row.truth - row.frame.origin)[axis] / stature_m);
      }
    const double ridge = system.best_ridge(kOffsetRidges);
    std::printf("  %s: left-out people %.2f %% of the stature off along each axis, ridge %g\n",
                member(joint).c_str(), 100.0 * system.left_out_error(ridge), ridge);
    out[member(joint)] = rounded(system.solve(ridge));
  }
  return out;
}

}  // namespace calibrate
