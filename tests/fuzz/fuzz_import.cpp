// Bytes as a body's file under the name of any format: the result is a mesh of finite positions, with or
// without a rig, or an error with a sentence.
#include <bodice/io/import.hpp>
#include <bodice/io/rig.hpp>

#include "harness.hpp"

using namespace bodice;

FUZZ_TARGET(import) {
  constexpr const char* kExtensions[] = {".obj", ".stl", ".ply"};
  const fuzz::TemporaryFile file(kExtensions[size % 3], {data, size});  // the format is that of the content
  const auto read = io::import_rigged_body({}, file.path(), {.unit = io::Unit::kMeter});
  fuzz::check_reported(read);
  if (!read.ok()) return 0;
  const geometry::TriMesh& skin = read->body.skin;
  for (const auto& p : skin.positions) FUZZ_CHECK(p.allFinite());
  for (const auto& t : skin.triangles)
    for (const auto v : t) FUZZ_CHECK(v < skin.positions.size());
  fuzz::check_reported(read->rig);
  return 0;
}
