#include <bodice/geometry/neighbors.hpp>

#include <algorithm>

namespace bodice::inline v0_1::geometry {

Neighbors::Neighbors(const TriMesh& mesh) : offset_(mesh.positions.size() + 1, 0) {
  for (const Triangle& t : mesh.triangles)
    for (const Index v : t) offset_[v + 1] += 2;
  for (std::size_t v = 1; v < offset_.size(); ++v) offset_[v] += offset_[v - 1];
  all_.resize(offset_.back());
  std::vector<std::size_t> next(offset_.begin(), offset_.end() - 1);
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      all_[next[t[k]]++] = t[(k + 1) % 3];
      all_[next[t[k]]++] = t[(k + 2) % 3];
    }
  std::size_t kept = 0;
  for (std::size_t v = 0; v + 1 < offset_.size(); ++v) {
    const auto begin = all_.begin() + static_cast<std::ptrdiff_t>(offset_[v]);
    const auto end = all_.begin() + static_cast<std::ptrdiff_t>(offset_[v + 1]);
    std::sort(begin, end);
    const auto last = std::unique(begin, end);
    std::copy(begin, last, all_.begin() + static_cast<std::ptrdiff_t>(kept));
    offset_[v] = kept;
    kept += static_cast<std::size_t>(last - begin);
  }
  offset_.back() = kept;
  all_.resize(kept);
}

}  // namespace bodice::geometry
