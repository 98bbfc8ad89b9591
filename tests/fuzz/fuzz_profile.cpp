// Bytes as a custom proportion profile.
#include <bodice/body/proportions.hpp>

#include "harness.hpp"

FUZZ_TARGET(profile) {
  const fuzz::TemporaryFile file(".json", {data, size});
  const auto profile = bodice::body::load_profile(file.path());
  fuzz::check_reported(profile);
  if (profile.ok()) FUZZ_CHECK(profile->either().knee_height > 0.0);
  return 0;
}
