// A tool that links everything: it makes the built-in body's proxy and writes it.
#include <cstdio>

#include <bodice/tryon/prepare.hpp>

int main() {
  using namespace bodice;
  const auto workers = engine::make_tbb_executor();
  const engine::Context context{.executor = workers.get()};
  auto skin = tryon::segment_builtin(context, {.vertices = 2000}, {});
  if (!skin) return std::puts(skin.error().sentence().c_str()), 1;
  const auto body = tryon::fit_proxy(context, std::move(skin).value(), {.tier = proxy::Tier::kSolid});
  if (!body) return std::puts(body.error().sentence().c_str()), 1;
  const auto missing = tryon::segment_file(context, "no_such_body.fbx", {});
  std::printf("%zu ellipsoids; %s\n", body->fit.proxy.ellipsoids().size(),
              missing ? "a file that is not there was read" : missing.error().sentence().c_str());
  return missing ? 1 : 0;
}
