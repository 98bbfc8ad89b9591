// Based on: F. N. Fritsch, J. Butland. A method for constructing local monotone piecewise cubic
// interpolants. 1984. (the slopes between sections, so that radii never overshoot the table)
#include "figure/loft.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace bodice::inline v0_1::synth {
namespace {

std::array<double, 5> row_of(const Section& section) {
  return {section.side, section.front, section.back, section.u, section.v};
}

/// The slope at a knot between two secants; it is zero at a local extremum.
double monotone_slope(double before, double after, double h_before, double h_after) {
  if (before * after <= 0.0) return 0.0;
  const double w1 = 2.0 * h_after + h_before, w2 = h_after + 2.0 * h_before;
  return (w1 + w2) / (w1 / before + w2 / after);
}

}  // namespace

Loft::Loft(const LoftFrame& frame, std::vector<Section> sections, double near_cap, double far_cap,
           double squareness)
    : frame_(frame), near_cap_(near_cap), far_cap_(far_cap), squareness_(squareness) {
  if (sections.size() == 1) {  // two knots close together, so that one code path suffices
    sections.push_back(sections[0]);
    sections[1].s += 1e-9;
  }
  for (const Section& section : sections) knots_.push_back(section.s);
  fit_cubics(sections);
  find_bound(sections);
}

void Loft::fit_cubics(const std::vector<Section>& sections) {
  const std::size_t n = sections.size();
  std::vector<Row> slope(n, Row{});
  const auto secant = [&](std::size_t i, int c) {
    return (row_of(sections[i + 1])[c] - row_of(sections[i])[c]) / (knots_[i + 1] - knots_[i]);
  };
  for (int c = 0; c < 5; ++c) {
    slope[0][c] = secant(0, c);
    slope[n - 1][c] = secant(n - 2, c);
    for (std::size_t i = 1; i + 1 < n; ++i)
      slope[i][c] = monotone_slope(secant(i - 1, c), secant(i, c), knots_[i] - knots_[i - 1],
                                   knots_[i + 1] - knots_[i]);
  }
  cubics_.resize(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double h = knots_[i + 1] - knots_[i];
    for (int c = 0; c < 5; ++c) {
      const double d = secant(i, c), m0 = slope[i][c], m1 = slope[i + 1][c];
      cubics_[i][0][c] = row_of(sections[i])[c];
      cubics_[i][1][c] = m0;
      cubics_[i][2][c] = (3.0 * d - 2.0 * m0 - m1) / h;
      cubics_[i][3][c] = (m0 + m1 - 2.0 * d) / (h * h);
    }
  }
}

void Loft::find_bound(const std::vector<Section>& sections) {
  const double low = knots_.front() - near_cap_, high = knots_.back() + far_cap_;
  bound_center_ = frame_.origin + 0.5 * (low + high) * frame_.along;
  double widest = 0.0;
  for (const Section& c : sections) {
    const double reach_u = c.side + std::abs(c.u), reach_v = std::max(c.front, c.back) + std::abs(c.v);
    widest = std::max(widest, std::hypot(reach_u, reach_v));
  }
  bound_radius_ = std::hypot(0.5 * (high - low), 1.1 * widest);
}

Loft::Row Loft::row_at(double s) const {
  std::size_t i = 0;
  while (i + 1 < cubics_.size() && s > knots_[i + 1]) ++i;
  const double t = s - knots_[i];
  const auto& k = cubics_[i];
  Row row;
  for (int c = 0; c < 5; ++c) row[c] = k[0][c] + t * (k[1][c] + t * (k[2][c] + t * k[3][c]));
  return row;
}

double Loft::value(const Vec3& p) const {
  const Vec3 q = p - frame_.origin;
  const double s = q.dot(frame_.along);
  const double inner = std::clamp(s, knots_.front(), knots_.back());
  const Row row = row_at(inner);
  const double beyond = s - inner;
  const double x = q.dot(frame_.u) - row[3], y = q.dot(frame_.v) - row[4];
  const double nx = x / row[0], ny = y / (y > 0.0 ? row[1] : row[2]);
  const double nz = beyond / (beyond > 0.0 ? far_cap_ : near_cap_);
  const double x2 = nx * nx, y2 = ny * ny, z2 = nz * nz;
  double norm = std::sqrt(x2 + y2 + z2);
  if (squareness_ > 0.0) norm += squareness_ * (std::sqrt(std::sqrt(x2 * x2 + y2 * y2 + z2 * z2)) - norm);
  const double least = std::min({row[0], row[1], row[2]});
  if (norm < 1e-6) return -least;
  const double length = std::sqrt(x * x + y * y + beyond * beyond);
  return std::max(length * (1.0 - 1.0 / norm), -least);
}

}  // namespace bodice::synth
