#pragma once

#include <vector>

#include <bodice/page/page.hpp>

namespace bodice::inline v0_1::page {

/// The 200 longest spans of a trace, in order of their begin.
std::vector<TaskSpan> tasks_of(const engine::Trace& trace);

}  // namespace bodice::page
