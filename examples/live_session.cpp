// A try-on: frames go on while the next body is prepared behind them, on the same workers.
//
//     submit(body A)                         submit(body B)
//        |  prepare A ......... coarse, finer   |  prepare B ....... coarse, finer
//        v                        |      |      v                      |
//     frame frame frame frame  [A]frame frame [A+]frame frame frame [B]frame ...
//
// A result takes effect between two frames only.

#include <chrono>
#include <cstdio>
#include <thread>

#include <bodice/tryon/session.hpp>
#include <bodice/tryon/wearing.hpp>

using namespace bodice;

int main() {
  const auto workers = engine::make_tbb_executor();
  const engine::Context context{.executor = workers.get()};
  tryon::Session session(context, {.fit = {.tier = proxy::Tier::kTight}});

  engine::Ticket ticket = session.submit(synth::BodyOptions{.vertices = 4500});
  bool dressed = false;
  int refinements = 0;
  std::uint64_t in_force = 0;
  auto next_display = std::chrono::steady_clock::now();
  for (int frame = 0; frame < 3600; ++frame) {
    std::this_thread::sleep_until(next_display += std::chrono::microseconds(16667));  // a display's 60 Hz
    const tryon::FrameOutcome outcome = session.frame(1.0 / 60.0);
    if (outcome.has_body && !dressed) {
      auto skirt = tryon::make_garment(context, *session.body()->skin);
      if (!skirt) return std::printf("%s\n", skirt.error().sentence().c_str()), 1;
      if (auto worn = session.dress({*skirt}); !worn)
        return std::printf("%s\n", worn.error().sentence().c_str()), 1;
      dressed = true;
    }
    if (outcome.proxy_hash != in_force) {
      in_force = outcome.proxy_hash;
      ++refinements;
      std::printf("frame %d: proxy %d of this body, %zu ellipsoids\n", frame, session.body()->refinement,
                  session.body()->proxy.ellipsoids().size());
    }
    if (!outcome.has_body) session.pipeline().run_pending();  // for an executor without a worker to spare
    if (ticket.done() && dressed) break;
  }
  const auto prepared = ticket.wait();
  if (!prepared) return std::printf("%s\n", prepared.error().sentence().c_str()), 1;
  std::printf("%d proxies took effect while frames ran\n", refinements);
  return dressed && refinements > 0 ? 0 : 1;
}
