#pragma once

namespace bodice_bench {

/// The number of processors that the machine gives at this moment. Threads that share nothing do the same
/// arithmetic (independent chains of multiply-add, as in the stages), one alone and `threads` at once, for
/// about 3 ms. Other programs lower the result, and so do hosts that lend two virtual processors of one real
/// one, which no operating system's statistics show.
double processors_given(int threads);

/// A sample is repeated if the machine gave less than this share of the sample's processors meanwhile, and
/// marked if no repetition had more.
inline constexpr double kFairShare = 0.96;

}  // namespace bodice_bench
