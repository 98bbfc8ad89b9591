// The tables of all ellipsoids as one sparse least-squares problem: neighbors share the samples between
// them, as they share the blended distance.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include <bodice/engine/context.hpp>

#include "relief/relief_grid.hpp"
#include "relief/relief_terms.hpp"

namespace bodice::fitting {

/// Regularised normal equations, applied without being formed. Unknowns of ellipsoid k: h, then a, of each
/// distinct node of its grid, meters.
class ReliefSystem {
 public:
  using Vector = Eigen::VectorXd;

  /// nodes_per_side  #E, each at least 2. `answers` must outlive the system.
  ReliefSystem(const engine::Context& context, const ReliefAnswers& answers,
               std::span<const int> nodes_per_side);

  /// Conjugate gradients with a diagonal preconditioner from `x`, at most `steps` of them, with the answers'
  /// weights as they are now. The same bits for any worker count.
  /// Where `free` is zero x stays as it is; elsewhere it is one.
  Vector solve(Vector x, int steps, const Vector& free) const;
  Eigen::Index unknowns() const { return static_cast<Eigen::Index>(unknowns_); }

  /// Brings every |a| within `limit_m`; zero in the result where it had to.
  Vector limit_slopes(Vector& x, double limit_m) const;

  /// #S: the blended distance less the true one, meters.
  std::vector<double> errors(const Vector& x) const;
  /// #E: sum of the shares of |error| over each ellipsoid's samples, meters.
  std::vector<double> error_of_each(const Vector& x) const;

  const ReliefGrid& grid(std::size_t ellipsoid) const { return *tables_[ellipsoid].grid; }
  /// #unknowns of one ellipsoid's grid, of a solution.
  std::span<const double> h(const Vector& x, std::size_t ellipsoid) const;
  std::span<const double> a(const Vector& x, std::size_t ellipsoid) const;
  /// #unknowns: the weight of the samples that speak for each node; zero where none does.
  std::span<const double> weight(std::size_t ellipsoid) const;

 private:
  struct Stencil {
    std::array<std::uint32_t, 4> unknown;  ///< among the ellipsoid's own
    std::array<float, 4> weight;
  };
  struct Table {
    std::shared_ptr<const ReliefGrid> grid;
    std::size_t first = 0;                          ///< unknown of the system
    double second = 0.0, slope = 0.0, ridge = 0.0;  ///< weights of the regularisation
    std::vector<double> weight;                     ///< #unknowns of the grid
  };

  void prepare(std::size_t ellipsoid);
  void read(const Vector& x) const;  ///< tables' values at every answer, then their sums a sample
  Vector write(std::span<const double> of_sample) const;  ///< the transpose of read
  void smooth(const Vector& x, Vector& y) const;          ///< adds the regularisation
  Vector inverse_diagonal() const;

  const engine::Context& context_;
  const ReliefAnswers& answers_;
  std::vector<Table> tables_;      ///< #E
  std::vector<Stencil> stencils_;  ///< #A
  std::size_t unknowns_ = 0;
  mutable std::vector<double> of_answer_;  ///< #A, scratch
  mutable std::vector<double> of_sample_;  ///< #S, scratch
};

}  // namespace bodice::fitting
