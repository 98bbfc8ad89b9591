#pragma once

namespace bodice_bench {

/// What the machine gives at this moment, in processors: threads that share nothing do the same arithmetic
/// (independent chains of multiply-add, as in the stages), one alone and `threads` at once, for about 3 ms.
/// Programs beside this one lower it, and so do hosts that lend two virtual processors of one real one, which
/// no operating system's statistics show.
double processors_given(int threads);

/// A sample beside which the machine gave less than this share of the processors it is about is repeated, and
/// marked if no time was better.
inline constexpr double kFairShare = 0.96;

}  // namespace bodice_bench
