// The modes of this program, one a file. Each prints a table with the bar beside the number and returns
// whether all bars hold.
#pragma once

#include <span>

namespace bench {

/// Time and contacts of each frame, for every garment of DATA/garments on its body. Arguments: DATA [tier
/// [frames [name part]]].
bool drape_garments(std::span<char*> arguments);

/// Random particles over all tiers, three poses and the modes of the response. Arguments: [particles [seed]].
bool certify_random(std::span<char*> arguments);

/// Normal jumps, chatter and cost at the creases of a body's proxy, with and without fillets.
bool cross_creases(std::span<char*> arguments);

/// Error of the float kernel's closest point against the solver in double precision. Arguments: [cases
/// [seed]].
bool measure_nearest(std::span<char*> arguments);

}  // namespace bench
