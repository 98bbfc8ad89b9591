#pragma once

namespace bench {

/// Prints what a frame of a skirt of some 10,000 particles costs on the built-in body that walks, with the
/// bar on it.
void print_walking();

}  // namespace bench
