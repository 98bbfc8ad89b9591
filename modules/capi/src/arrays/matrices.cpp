#include "arrays/matrices.hpp"

#include <cmath>

#include "arrays/strided.hpp"

namespace bodice::inline v0_1::capi {
namespace {

/// Where the number of a row and column stands in a matrix of the host.
int index_of(std::int32_t layout, int row, int column) {
  switch (layout) {
    case BODICE_COLUMNS_4X4:
      return 4 * column + row;
    case BODICE_COLUMNS_3X4:
      return 3 * column + row;
    default:
      return 4 * row + column;
  }
}

std::size_t matrix_bytes(const bodice_pose& pose) {
  const bool four = pose.layout == BODICE_ROWS_4X4 || pose.layout == BODICE_COLUMNS_4X4;
  return (four ? 16 : 12) * (pose.scalar == BODICE_DOUBLE ? sizeof(double) : sizeof(float));
}

Strided matrices_of(const bodice_pose& pose) {
  const auto packed = static_cast<std::ptrdiff_t>(matrix_bytes(pose));
  // The numbers are only read; Strided serves for both.
  return {static_cast<char*>(const_cast<void*>(pose.matrices)), pose.stride == 0 ? packed : pose.stride};
}

}  // namespace

Outcome check_matrices(const bodice_pose& pose, std::size_t wanted, const char* what) {
  if (pose.layout < BODICE_ROWS_3X4 || pose.layout > BODICE_COLUMNS_3X4)
    return invalid("bodice_pose.layout is " + std::to_string(pose.layout) + ".",
                   "Give BODICE_ROWS_3X4 or another of its values.");
  if (pose.scalar != BODICE_FLOAT && pose.scalar != BODICE_DOUBLE)
    return invalid("bodice_pose.scalar is " + std::to_string(pose.scalar) + ".",
                   "Give BODICE_FLOAT or BODICE_DOUBLE.");
  if (!pose.matrices && wanted > 0) return invalid("bodice_pose.matrices is null.", "Pass the first matrix.");
  if (pose.count != wanted)
    return invalid("The pose has " + std::to_string(pose.count) + " matrices, there are " +
                       std::to_string(wanted) + " " + what + ".",
                   "Pass one for each, in their order.");
  if (!std::isfinite(pose.dt_s))
    return invalid("bodice_pose.dt_s is not finite.", "Give the seconds since the last pose, or 0.");
  Strided ignored;
  return read_elements(const_cast<void*>(pose.matrices), pose.stride, matrix_bytes(pose), wanted,
                       "bodice_pose.matrices", ignored);
}

void read_matrices(const bodice_pose& pose, std::span<proxy::JointMatrix> out) {
  const Strided matrices = matrices_of(pose);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Strided numbers{matrices.at(i), static_cast<std::ptrdiff_t>(
                                              pose.scalar == BODICE_DOUBLE ? sizeof(double) : sizeof(float))};
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) {
        const auto at = static_cast<std::size_t>(index_of(pose.layout, row, column));
        out[i](row, column) =
            pose.scalar == BODICE_DOUBLE ? numbers.get<double>(at) : double{numbers.get<float>(at)};
      }
    }
  }
}

}  // namespace bodice::capi
