// A body on its course through bodice, as one picture: mesh, landmarks, parts, ellipsoids, cloth.
//
//     skin --> landmarks --> parts --> ellipsoids --> cloth draped over them
//      |           |           |           |            |
//      +-----------+-----------+-----------+------------+--> stages.png, from left to right

#include <cstdio>
#include <cstdlib>
#include <vector>

#include <bodice/tryon/drape.hpp>
#include <bodice/tryon/wearing.hpp>

using namespace bodice;

namespace {

/// Stops the program with the sentence of an error.
template <class T>
T value_or_exit(engine::Result<T> result) {
  if (result) return std::move(result).value();
  std::printf("%s\n", result.error().sentence().c_str());
  std::exit(1);
}

}  // namespace

int main(int argc, char** argv) {
  const auto workers = engine::make_tbb_executor();
  const engine::Context context{.executor = workers.get()};

  auto skin = argc > 1 ? tryon::segment_file(context, argv[1], {})
                       : tryon::segment_builtin(context, {.vertices = 3500}, {});
  auto body =
      value_or_exit(tryon::fit_proxy(context, value_or_exit(std::move(skin)), {.tier = proxy::Tier::kTight}));
  const anatomy::Anatomy& anatomy = body.skin.anatomy;
  auto skirt = value_or_exit(tryon::make_garment(context, body.skin));
  auto draped =
      value_or_exit(tryon::drape(context, body, {std::move(skirt)}, {.frames = 60, .kept_frames = 2}));

  std::vector<geometry::Vec3> landmarks;
  for (const body::Landmark& landmark : anatomy.landmarks) landmarks.push_back(landmark.position);
  io::Scene scene{.body = &body.skin.input.skin,
                  .part = anatomy.part,
                  .proxy = &body.fit.proxy,
                  .landmarks = landmarks,
                  .garments = std::move(draped.garments)};
  if (auto saved = io::write_stages_picture(scene, "stages.png", {.width = 240, .height = 330}); !saved)
    return std::printf("%s\n", saved.error().sentence().c_str()), 1;
  std::printf("wrote stages.png\n");
}
