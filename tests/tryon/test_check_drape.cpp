// Inputs that a drape refuses before its first frame.

#include <doctest/doctest.h>

#include <utility>

#include <bodice/tryon/drape.hpp>

#include "builtin.hpp"

using namespace bodice;

TEST_CASE("the body's own skin is refused as a garment; an offset copy or a part of it is not") {
  const tryon::PreparedBody& body = builtin_body(2000, proxy::Tier::kTight);
  const geometry::TriMesh& skin = body.skin.input.skin;
  tryon::DrapeOptions options;
  options.frames = 1;
  options.solver.substeps = 1;
  const auto drape = [&](geometry::TriMesh mesh) {
    return tryon::drape({}, body, {{.name = "suit", .mesh = std::move(mesh), .held = {}}}, options);
  };
  const auto refused = drape(skin);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().message == "suit: this garment is the skin of the body itself.");
  geometry::TriMesh half = skin;
  half.triangles.resize(half.triangles.size() / 2);
  CHECK(drape(half).ok());
  geometry::TriMesh off = skin;
  for (geometry::Vec3& p : off.positions) p.z() += 0.01;
  CHECK(drape(off).ok());
}
