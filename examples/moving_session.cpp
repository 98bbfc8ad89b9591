// A body that plays a clip under its skirt, frame by frame: it sits down, and tables that fit a seat are made
// behind the frames.
//
//     play(sit)        far from what the tables are for: a refit begins behind the frames
//        v               v                                  ready: it comes in over ten frames
//     [ramp][frame][frame][frame] .... [frame][frame] .... [frame][frame]

#include <chrono>
#include <cstdio>
#include <thread>

#include <bodice/tryon/session.hpp>
#include <bodice/tryon/wearing.hpp>

using namespace bodice;

namespace {

int failed(const engine::Error& error) {
  return std::printf("%s\n", error.sentence().c_str()), 1;
}

}  // namespace

int main() {
  const auto workers = engine::make_tbb_executor();
  const engine::Context context{.executor = workers.get()};
  tryon::SessionOptions options;
  options.fit.max_ellipsoids = 60;
  options.moves = true;  // bodies get a rig, and proxies that follow it
  tryon::Session session(context, options);

  const engine::Ticket ready = session.submit(synth::BodyOptions{.vertices = 4500});
  if (const auto prepared = ready.wait(); !prepared) return failed(prepared.error());
  session.frame(0.0);  // a boundary, at which the body is taken
  auto skirt = tryon::make_garment(context, *session.body()->skin);
  if (!skirt) return failed(skirt.error());
  if (auto worn = session.dress({*skirt}); !worn) return failed(worn.error());

  // The clip is found behind the frames; a clip that is not there would be an error of this ticket.
  const engine::Ticket clip = session.play({.motion = "sit"}, {.loop = false});
  if (const auto found = clip.wait(); !found) return failed(found.error());
  int refits = 0;
  tryon::FrameOutcome outcome;
  for (int frame = 0; frame < 240; ++frame) {
    outcome = session.frame(1.0 / 60.0);
    if (outcome.took_refit)
      std::printf("frame %d: tables of another pose, %.2f s into the clip\n", frame, outcome.clip_s);
    refits += outcome.took_refit;
    if (frame == 200) session.seek(0.5, 0.4);  // back up again, over .4 s so that the skirt can follow
    // A display would wait for its next refresh here, which leaves time for what runs behind.
    std::this_thread::sleep_for(std::chrono::milliseconds(4));
  }
  std::printf("%d refits came into use; the skirt has %zu vertices\n", refits, session.vertices());
  return outcome.plays && outcome.cloth.finite ? 0 : 1;
}
