// The ellipsoids around places that are asked about again and again: where pushes have led to, round after
// round and call after call. They are found for the box of the places with some reach to spare.
#if defined(BODICE_COLLISION_AROUND_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_AROUND_INL_
#undef BODICE_COLLISION_AROUND_INL_
#else
#define BODICE_COLLISION_AROUND_INL_
#endif

#include <algorithm>
#include <cmath>

#include "kept.hpp"
#include "simd/share-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

/// Of one batch in one call.
struct Around {
  KeptAround* kept;    ///< from call to call, or of this call only
  double travelled_m;  ///< length of the proxy's way
  float least_reach_m, most_reach_m;
  bool filled = false;   ///< the columns hold what is kept
  bool counted = false;  ///< as a use of it

  HWY_INLINE Around(const Keeping& keeping, float reach_m, KeptAround& of_call)
      : kept(keeping.batch ? &keeping.batch->pushed : &of_call),
        travelled_m(keeping.travelled_m),
        least_reach_m(keeping.batch ? keeping.least_reach_m : reach_m),
        most_reach_m(keeping.batch ? keeping.most_reach_m : reach_m) {}
};

/// How far places of the box are from the one that was asked about, at most.
HWY_INLINE float overhang_m(const KeptAround& kept, const Extent& box) {
  float sum = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const float below = kept.low[axis] - (box.middle[axis] - box.half[axis]);
    const float above = box.middle[axis] + box.half[axis] - kept.high[axis];
    const float over = std::max(0.0f, std::max(below, above));
    sum += over * over;
  }
  return std::sqrt(sum);
}

HWY_INLINE bool holds(const Around& around, const Extent& box, float limit_m) {
  const KeptAround& kept = *around.kept;
  return kept.count > 0 && kept.limit_m == limit_m && overhang_m(kept, box) < kept.left_m(around.travelled_m);
}

/// Finds what is to be kept; false if it does not fit. `find` as in share(), and how much farther.
template <class Find>
HWY_INLINE bool keep(const Baked& baked, const Piece& all_places, float limit_m, Around& around, Near& list,
                     Find&& find) {
  KeptAround& kept = *around.kept;
  around.filled = false;
  if (!kept.renew(around.least_reach_m, around.most_reach_m)) return false;
  if (!find(Everything(baked), all_places.box, &all_places, 1, &list, kept.reach_m) ||
      list.count > std::min(2 * kWidth, KeptAround::kMost)) {
    kept.give_up();
    return false;
  }
  for (int axis = 0; axis < 3; ++axis) {
    kept.low[axis] = all_places.box.middle[axis] - all_places.box.half[axis];
    kept.high[axis] = all_places.box.middle[axis] + all_places.box.half[axis];
  }
  std::copy_n(list.index, list.count, kept.candidate);
  kept.candidates = list.count;
  kept.limit_m = limit_m;
  kept.travelled_m = around.travelled_m;
  kept.count = all_places.end;
  return true;
}

/// As share(), among what is kept as long as that holds; `find` (a source, the box around, pieces, their
/// number, lists out, how much farther than asked), which looks for ellipsoids within `limit_m`.
template <class Find, class Work>
HWY_INLINE bool share_around(const Baked& baked, const ReliefTables* relief, const Piece* pieces, int count,
                             float limit_m, Lists& s, Around& around, Find&& find, Work&& work) {
  Piece all_places = pieces[0];
  for (int i = 1; i < count; ++i) all_places.box = united(all_places.box, pieces[i].box);
  all_places.end = pieces[count - 1].end;
  const auto find_exactly = [&](const auto& source, const Extent& box, const Piece* some, int number,
                                Near* lists) { return find(source, box, some, number, lists, 0.0f); };
  const bool held = holds(around, all_places.box, limit_m);
  if (held && !around.counted) ++around.kept->used;
  around.counted = true;
  if (!held && !keep(baked, all_places, limit_m, around, s.near, find))
    return share(baked, relief, pieces, count, s, find_exactly, work);
  if (around.kept->candidates == 0) return true;
  if (!around.filled) s.columns.fill(baked, relief, around.kept->candidate, around.kept->candidates);
  around.filled = true;
  bool fits = false;
  with_tables(s.columns, [&](auto tables) {
    (void)find_exactly(AmongColumns<tables()>{s.columns}, all_places.box, pieces, count, s.of_piece);
    fits = work(tables, s.columns, pieces, count, s.of_piece);
  });
  return fits;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
