// A grid as slices across the axis along which a body stands.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include <bodice/geometry/contour.hpp>

namespace bodice::inline v0_1::anatomy {

/// A point or a direction in the plane of a slice, in nodes.
using SlicePoint = std::array<double, 2>;

/// The slices across the longest axis of a grid. Nodes at its border are outside of the body. Nodes of a
/// slice are numbered from 0 to plane() - 1.
class Slices {
 public:
  explicit Slices(const geometry::FieldGrid& depth) : depth_(&depth) {
    const auto& n = depth.nodes;
    const std::array<std::size_t, 3> stride{1, n[0], n[0] * n[1]};
    const auto axis = static_cast<std::size_t>(std::max_element(n.begin(), n.end()) - n.begin());
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    count_ = n[axis], along_ = stride[axis];
    width_ = n[u], across_ = stride[u];
    height_ = n[v], upward_ = stride[v];
  }

  std::size_t count() const { return count_; }
  /// Number of slices of a share of the grid's length.
  std::size_t count(double share) const {
    return static_cast<std::size_t>(share * static_cast<double>(count_));
  }
  std::size_t plane() const { return width_ * height_; }
  /// Number of a slice's node in the grid.
  std::size_t node(std::size_t slice, std::size_t i) const {
    return slice * along_ + i % width_ * across_ + i / width_ * upward_;
  }
  double u(std::size_t i) const { return static_cast<double>(i % width_); }
  double v(std::size_t i) const { return static_cast<double>(i / width_); }
  /// Whether nodes on all sides of these coordinates are in the slice.
  bool holds(long u, long v) const {
    return u > 0 && v > 0 && u + 1 < static_cast<long>(width_) && v + 1 < static_cast<long>(height_);
  }
  std::size_t at(long u, long v) const {
    return static_cast<std::size_t>(v) * width_ + static_cast<std::size_t>(u);
  }
  float depth(std::size_t slice, std::size_t i) const { return depth_->value[node(slice, i)]; }
  double cell() const { return depth_->cell_m; }

  /// The middle of the nodes i of a slice for which belongs(i) is true; zero if there is none.
  template <class Belongs>
  SlicePoint middle(Belongs&& belongs) const {
    double u_sum = 0.0, v_sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < plane(); ++i)
      if (belongs(i)) u_sum += u(i), v_sum += v(i), ++count;
    return count > 0.0 ? SlicePoint{u_sum / count, v_sum / count} : SlicePoint{0.0, 0.0};
  }

  /// Visits the four neighbors of a node that is not at the border, and with `diagonal` four more.
  template <class Visit>
  void for_neighbors(std::size_t i, bool diagonal, Visit&& visit) const {
    for (int dv = -1; dv <= 1; ++dv)
      for (int du = -1; du <= 1; ++du)
        if ((du != 0 || dv != 0) && (diagonal || du == 0 || dv == 0))
          visit(static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) + du +
                                         dv * static_cast<std::ptrdiff_t>(width_)));
  }

 private:
  const geometry::FieldGrid* depth_;
  std::size_t count_ = 0, along_ = 0, width_ = 0, across_ = 0, height_ = 0, upward_ = 0;
};

}  // namespace bodice::anatomy
