#pragma once

namespace bench {

/// Prints what geodesics, landmarks and segmentation take: stage by stage on the paper's size of body with
/// one and two workers, and in all up to 800,000 vertices, beside n log n.
void print_cost();

}  // namespace bench
