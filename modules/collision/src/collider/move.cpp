// Poses of a collider: checked, mended, and taken.
#include <algorithm>
#include <optional>

#include "collider/collider_impl.hpp"
#include "collider/mended_ellipsoid.hpp"

namespace bodice::inline v0_1::collision {
namespace {

/// A step outside of these has no velocity that floats could hold, seconds: a body that moves by a kilometer
/// within the shortest one still has.
constexpr double kShortestStep_s = 1e-9, kLongestStep_s = 1e9;

/// The step that velocities follow from; zero if there is none.
double usable_step_s(double dt_s) {
  return dt_s >= kShortestStep_s && dt_s <= kLongestStep_s ? dt_s : 0.0;
}

}  // namespace

void Collider::Impl::move(std::span<const geometry::Ellipsoid> now,
                          std::span<const geometry::Mat3> axes_of_material, double step_s) noexcept {
  const double dt_s = usable_step_s(step_s);
  material.swap(material_before);
  for (std::size_t k = 0; k < now.size(); ++k) {
    const std::uint32_t at = internal_index[k];
    shapes[at] = now[k];
    shapes[at].center -= origin;
    material[at].set(now[k].center - origin,
                     axes_of_material.empty() ? material_of(now[k]).axes : axes_of_material[k]);
  }
  // Motions have a pass of their own: a processor waits for what it has just written in parts to be read as a
  // whole.
  double farthest_m = 0.0;
  for (std::size_t k = 0; k < material.size(); ++k) {
    motion[k].set(material_before[k], material[k], dt_s);
    affine_motions[k].set(material_before[k], material[k]);
    farthest_m = std::max(farthest_m, travel_between(material_before[k], material[k]));
  }
  poses += farthest_m > 0.0;
  moving = dt_s > 0.0;
  moved_dt_s = dt_s;
  travel_m = static_cast<float>(1.001 * farthest_m);
  field.update(shapes);
  model.baked.update(shapes, field.boxes());
}

bool Collider::Impl::take(std::span<const geometry::Ellipsoid> now) noexcept {
  if (now.size() != trial.size()) return false;
  std::ranges::copy(now, trial.begin());
  return std::ranges::all_of(trial, [](geometry::Ellipsoid& shape) { return mend(shape).empty(); });
}

bool Collider::move_to(std::span<const geometry::Ellipsoid> shapes, double dt_s) noexcept {
  if (!impl_->take(shapes)) return false;
  impl_->move(impl_->trial, {}, dt_s);
  return true;
}

bool Collider::pose(const proxy::PosedProxy& posed, double dt_s) noexcept {
  const std::optional<ReliefTables>& tables = impl_->model.relief;
  const std::size_t texels = tables ? impl_->texels : 0;
  if (tables && (posed.relief.size() != size() || posed.texels.size() != texels)) return false;
  if (!(posed.scale > 0.0) || posed.material.size() != size() || !impl_->take(posed.shapes)) return false;
  impl_->move(impl_->trial, posed.material, dt_s);
  impl_->margin_m = impl_->rest_margin_m * posed.scale;
  if (tables) impl_->model.relief->update(posed, impl_->stature_m, impl_->proxy_index);
  return true;
}

}  // namespace bodice::collision
