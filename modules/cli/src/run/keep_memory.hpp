// Memory that was freed, for a program that does one thing and ends.
#pragma once

namespace bodice::inline v0_1::cli {

/// Has the process keep freed memory for what comes next, up to some hundred megabytes. By default each large
/// array returns to the system, and the next one comes page by page: a twentieth of the time of a fine scan.
/// Does nothing without the GNU C library.
void keep_freed_memory();

}  // namespace bodice::cli
