// bodice.hpp includes what it uses: here it comes first, and alone.
#include <bodice.hpp>
