#include "model/surface_motion.hpp"

#include <Eigen/LU>

namespace bodice::inline v0_1::collision {

using geometry::Mat3;
using geometry::Vec3;

Vec3 SurfaceMotion::at(const Vec3& x) const {
  Vec3 velocity;
  for (int row = 0; row < 3; ++row)
    velocity[row] = double{linear[3 * row]} * x[0] + double{linear[3 * row + 1]} * x[1] +
                    double{linear[3 * row + 2]} * x[2] + double{translation[row]};
  return velocity;
}

void InvertedMaterial::set(const Vec3& new_center, const Mat3& new_axes) {
  center = new_center;
  axes = new_axes;
  inverse_axes = new_axes.inverse();
}

double travel_between(const Material& before, const Material& now) {
  return (now.center - before.center).norm() + (now.axes - before.axes).norm();
}

void SurfaceMotion::set(const InvertedMaterial& before, const InvertedMaterial& now, double dt_s) {
  if (!(dt_s > 0.0)) {
    *this = {};
    return;
  }
  // x_before = c' + M' M^-1 (x - c);  velocity = (x - x_before) / dt
  const Mat3 back = before.axes * now.inverse_axes;
  const Mat3 turn = (Mat3::Identity() - back) / dt_s;
  const Vec3 shift = (back * now.center - before.center) / dt_s;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      linear[3 * row + column] = static_cast<float>(turn(row, column));
    translation[row] = static_cast<float>(shift[row]);
  }
}

}  // namespace bodice::collision
