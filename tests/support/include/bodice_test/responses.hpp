// All responses by name, for what each of them has to keep.
#pragma once

#include <bodice/collision/collider.hpp>

namespace bodice_test {

struct NamedResponse {
  const char* name;
  bodice::collision::Response response;
};

inline constexpr NamedResponse kResponses[] = {{"closest point", bodice::collision::Response::kClosestPoint},
                                               {"paper", bodice::collision::Response::kPaper}};

/// Whether a response leaves no particle inside.
constexpr bool leaves_none_inside(bodice::collision::Response response) {
  return response != bodice::collision::Response::kPaper;
}

}  // namespace bodice_test
