#include "cover/column_lines.hpp"

namespace bodice::inline v0_1::fitting {

namespace {

/// An ellipsoid that reaches a row of columns, with the first and the last column that it may reach.
struct InRow {
  std::uint32_t ellipsoid;
  int first, last;
};

std::vector<InRow> reaching(const InteriorColumns& columns, double z, std::span<const ColumnLine> lines) {
  std::vector<InRow> found;
  for (std::uint32_t e = 0; e < lines.size(); ++e) {
    const geometry::Box& box = lines[e].box;
    if (z < box.low.z() || z > box.high.z()) continue;
    const auto [first, last] =
        cells_within(box.low.x(), box.high.x(), columns.low.x(), columns.spacing_m, columns.nx);
    if (first <= last) found.push_back({e, first, last});
  }
  return found;
}

}  // namespace

RowCover cover_row(const InteriorColumns& columns, int k, std::span<const ColumnLine> lines) {
  RowCover row;
  const double z = columns.z(k);
  const std::vector<InRow> in_row = reaching(columns, z, lines);
  for (int i = 0; i < columns.nx; ++i) {
    row.begin.push_back(static_cast<std::uint32_t>(row.parts.size()));
    if (columns.at(i, k).empty()) continue;
    for (const auto& [e, first, last] : in_row) {
      if (i < first || i > last) continue;
      const InteriorColumns::Stretch s = lines[e].inside(columns.x(i), z);
      if (s.first < s.second) row.parts.push_back({e, s});
    }
  }
  row.begin.push_back(static_cast<std::uint32_t>(row.parts.size()));
  return row;
}

void subtract(const InteriorColumns::Stretch& wanted, std::span<const InteriorColumns::Stretch> covered,
              double shortest, std::vector<InteriorColumns::Stretch>& left) {
  double from = wanted.first;
  const auto note = [&](double to) {
    if (to - from > shortest) left.emplace_back(from, to);
  };
  for (const auto& [begin, end] : covered) {
    if (end <= from) continue;
    if (begin >= wanted.second) break;
    note(begin);
    from = end;
    if (from >= wanted.second) return;
  }
  note(wanted.second);
}

}  // namespace bodice::fitting
