// Appends one list to another.
#pragma once

#include <vector>

namespace bodice::inline v0_1::tryon {

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace bodice::tryon
