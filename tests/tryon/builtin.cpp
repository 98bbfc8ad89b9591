#include "builtin.hpp"

#include <map>
#include <utility>

#include <doctest/doctest.h>

#include <bodice/tryon/rigged_body.hpp>

using namespace bodice;

namespace {

using Fitted = std::map<std::pair<int, proxy::Tier>, tryon::PreparedBody>;

tryon::PreparedBody needed(engine::Result<tryon::PreparedBody> body) {
  REQUIRE_MESSAGE(body.ok(), body.error().sentence());
  return std::move(body).value();
}

}  // namespace

const tryon::SegmentedSkin& builtin_skin(int vertices) {
  static std::map<int, tryon::SegmentedSkin> made;
  const auto known = made.find(vertices);
  if (known != made.end()) return known->second;
  auto skin = tryon::segment_builtin({}, {.vertices = vertices}, {});
  REQUIRE_MESSAGE(skin.ok(), skin.error().sentence());
  return made.emplace(vertices, std::move(skin).value()).first->second;
}

const tryon::PreparedBody& builtin_body(int vertices, proxy::Tier tier) {
  static Fitted made;
  const auto known = made.find({vertices, tier});
  if (known != made.end()) return known->second;
  auto body = needed(tryon::fit_proxy({}, builtin_skin(vertices), {.tier = tier}));
  return made.emplace(std::pair(vertices, tier), std::move(body)).first->second;
}

tryon::PreparedBody make_bound_builtin_body(const engine::Context& context, int vertices, proxy::Tier tier) {
  const synth::BodyOptions builtin{.vertices = vertices};
  auto skin = tryon::segment_builtin(context, builtin, {});
  REQUIRE_MESSAGE(skin.ok(), skin.error().sentence());
  REQUIRE(tryon::give_rig(context, builtin, *skin).ok());
  return needed(tryon::fit_bound_proxy(context, std::move(skin).value(), {.tier = tier}));
}

const tryon::PreparedBody& bound_builtin_body(int vertices, proxy::Tier tier) {
  static Fitted made;
  const auto known = made.find({vertices, tier});
  if (known != made.end()) return known->second;
  auto body = make_bound_builtin_body({}, vertices, tier);
  return made.emplace(std::pair(vertices, tier), std::move(body)).first->second;
}
