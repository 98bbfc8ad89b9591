#pragma once

namespace bench {

/// Prints what a frame of cloth costs on the built-in body that walks, and the skin that shows through it: a
/// skirt of some 10,000 particles and a dress of some 15,000, each with the bars on it.
void print_walking();

}  // namespace bench
