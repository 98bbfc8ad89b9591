// Makes a proxy of a mesh, and prints what the proxy promises.
//
//     skin --> landmarks --> 15 parts --> ellipsoids --> BodyProxy --> file
//                                              |
//                          exact signed distance to the skin: how good is it?

#include <cstdio>

#include <bodice/proxy/proxy_file.hpp>
#include <bodice/tryon/prepare.hpp>

using namespace bodice;

int main(int argc, char** argv) {
  const auto workers = engine::make_tbb_executor();
  const engine::Context context{.executor = workers.get()};

  auto skin = argc > 1 ? tryon::segment_file(context, argv[1], {}) : tryon::segment_builtin(context, {}, {});
  if (!skin) return std::printf("%s\n", skin.error().sentence().c_str()), 1;
  for (const body::Landmark& landmark : skin->anatomy.landmarks)
    std::printf("%-12s %6.3f %6.3f %6.3f m, confidence %.2f\n", body::name(landmark.id).data(),
                landmark.position.x(), landmark.position.y(), landmark.position.z(), landmark.confidence);

  const auto body = tryon::fit_proxy(context, std::move(skin).value(), {.tier = proxy::Tier::kSolid});
  if (!body) return std::printf("%s\n", body.error().sentence().c_str()), 1;
  for (const fitting::PartFit& part : body->fit.parts)
    std::printf("%-12s %3zu ellipsoids, gap %5.2f mm mean, %5.2f mm at most\n", body::name(part.part).data(),
                part.ellipsoids, part.gap_m.mean * 1e3, part.gap_m.max * 1e3);

  const auto saved = proxy::save(body->fit.proxy, "body.json");
  if (!saved) return std::printf("%s\n", saved.error().sentence().c_str()), 1;
  std::printf("wrote body.json\n");
}
