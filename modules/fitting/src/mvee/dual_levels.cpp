#include "mvee/dual_levels.hpp"

#include "base/vector_clones.hpp"

namespace bodice::inline v0_1::fitting {

BODICE_CLONES void dual_levels(const LiftedMap& map, std::size_t n, const double* __restrict x,
                               const double* __restrict y, const double* __restrict z,
                               double* __restrict level) {
  const LiftedMap m = map;
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0.0;
    for (int r = 0; r < 4; ++r) {
      const double along = m.row[r][0] * x[i] + m.row[r][1] * y[i] + m.row[r][2] * z[i] + m.row[r][3];
      sum += along * along;
    }
    level[i] = sum;
  }
}

}  // namespace bodice::fitting
