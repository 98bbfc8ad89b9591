// Bytes as a body's file, in the formats with small readers: the result is a mesh of finite positions, or an
// error with a sentence.
#include <bodice/io/import.hpp>

#include "harness.hpp"

using namespace bodice;

FUZZ_TARGET(import) {
  constexpr const char* kExtensions[] = {".obj", ".stl", ".ply"};
  fuzz::Bytes in(data, size);
  const char* extension = kExtensions[in.next() % 3];
  const fuzz::TemporaryFile file(extension, in.rest());
  const auto body = io::import_body({}, file.path(), {.unit = io::Unit::kMeter});
  fuzz::check_reported(body);
  if (!body.ok()) return 0;
  for (const auto& p : body->skin.positions) FUZZ_CHECK(p.allFinite());
  for (const auto& t : body->skin.triangles)
    for (const auto v : t) FUZZ_CHECK(v < body->skin.positions.size());
  return 0;
}
