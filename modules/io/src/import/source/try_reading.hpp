// Readers that crash on damaged files, tried in a process of their own.
#pragma once

#include <functional>

namespace bodice::inline v0_1::io {

/// How a function that was tried in a child ended.
enum class Ending { kEnds, kCrashes, kRunsOn };

/// How a function ends in a copy of this process, which prints nothing and is gone afterwards. kRunsOn: it
/// took more processor time than `most_s`. kEnds also where no such copy can be made, or its end is not
/// known. Thread-safe. Cost: that of the function, and of a fork.
Ending try_in_child(const std::function<void()>& function, unsigned most_s);

}  // namespace bodice::io
