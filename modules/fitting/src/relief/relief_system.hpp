// The tables of all ellipsoids as one sparse least-squares problem. They are coupled, because the distance at
// a sample blends the tables of neighboring ellipsoids.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include <bodice/engine/context.hpp>

#include "relief/relief_grid.hpp"
#include "relief/relief_terms.hpp"

namespace bodice::inline v0_1::fitting {

/// The regularized normal equations, applied without being formed. The unknowns of an ellipsoid are h of each
/// distinct node of its grid, then a of each, in meters.
class ReliefSystem {
 public:
  using Vector = Eigen::VectorXd;

  /// nodes_per_side  #E, each at least 2. `terms` must outlive the system.
  ReliefSystem(const engine::Context& context, const ReliefTerms& terms, std::span<const int> nodes_per_side);

  /// Solves by at most `steps` conjugate gradients from `x`, with the weights that the terms have now. `free`
  /// is zero for unknowns that keep their value and one for the others. The same bits for any worker count.
  Vector solve(Vector x, int steps, const Vector& free) const;
  Eigen::Index unknowns() const { return static_cast<Eigen::Index>(unknowns_); }

  /// Clamps every a in x to `limit_m`. Returns `free` for solve(): zero where a was clamped, else one.
  Vector limit_slopes(Vector& x, double limit_m) const;

  /// #S: the blended distance less the true one, meters.
  std::vector<double> errors(const Vector& x) const;
  /// #E: the sum of the ellipsoid's shares of |error| over its samples, meters.
  std::vector<double> error_of_each(const Vector& x) const;

  const ReliefGrid& grid(std::size_t ellipsoid) const { return *tables_[ellipsoid].grid; }
  /// The unknown of a solution at which the values h of an ellipsoid's grid begin; those of a follow.
  std::size_t first(std::size_t ellipsoid) const { return tables_[ellipsoid].first; }
  /// #unknowns of one ellipsoid's grid: the values h, and the values a, of a solution.
  std::span<const double> h(const Vector& x, std::size_t ellipsoid) const;
  std::span<const double> a(const Vector& x, std::size_t ellipsoid) const;
  /// #unknowns of one ellipsoid's grid: the weight of the samples that determine each node; zero where none
  /// does.
  std::span<const double> weight(std::size_t ellipsoid) const;

 private:
  /// The four nodes around a direction, with their bilinear weights.
  struct Stencil {
    std::array<std::uint32_t, 4> unknown;  ///< unknowns of the ellipsoid's grid
    std::array<float, 4> weight;
  };
  struct Table {
    std::shared_ptr<const ReliefGrid> grid;
    std::size_t first = 0;                          ///< the system's unknown at which the table begins
    double second = 0.0, slope = 0.0, ridge = 0.0;  ///< weights of the regularization
    std::vector<double> weight;                     ///< #unknowns of the grid
  };

  void prepare(std::size_t ellipsoid);
  void read(const Vector& x) const;  ///< the tables' values for every term, then their sums a sample
  Vector write(std::span<const double> of_sample) const;  ///< the transpose of read()
  void smooth(const Vector& x, Vector& y) const;          ///< adds the regularization
  Vector inverse_diagonal() const;

  const engine::Context& context_;
  const ReliefTerms& terms_;
  std::vector<Table> tables_;      ///< #E
  std::vector<Stencil> stencils_;  ///< #T
  std::size_t unknowns_ = 0;
  mutable std::vector<double> of_term_;    ///< #T, scratch of read()
  mutable std::vector<double> of_sample_;  ///< #S, result of read()
};

}  // namespace bodice::fitting
