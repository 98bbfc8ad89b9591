// The questions that this program answers, one a file. Each prints a table with the bar beside the number
// and returns whether all bars hold.
#pragma once

#include <span>

namespace bench {

/// Every garment of DATA/garments on its body: time and contacts of each frame.
/// Arguments: DATA [tier [frames [name part]]].
bool drape_garments(std::span<char*> arguments);

/// Random particles over all tiers, three poses and the modes of the response. Arguments: [particles].
bool certify_random(std::span<char*> arguments);

/// Normal jumps, chatter and cost at the creases of a body's proxy, with and without fillets.
bool cross_creases(std::span<char*> arguments);

/// The float kernel's closest point against the solver in double. Arguments: [cases].
bool measure_nearest(std::span<char*> arguments);

}  // namespace bench
