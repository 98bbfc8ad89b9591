// How far is the proxy of a body that moves from its posed skin, and what does a frame cost? Beside it on the
// same clips: rigid capsules a bone, Embree's tree refitted with normals, and a 10 mm grid rebuilt a frame.
// Bodies are the built-in one, or the rigs of --data DIR (DIR/rigs/*.glb, with their own clips besides).
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include <CLI/CLI.hpp>

#include <bodice/binding/bind.hpp>
#include <bodice/tryon/base_pose.hpp>
#include <bodice/tryon/rigged_body.hpp>

#include <bench_support/or_exit.hpp>
#include <bench_support/stopwatch.hpp>

#include "posed_proxy.hpp"
#include "report.hpp"

namespace {

using namespace bodice;

constexpr double kReach_m = 0.031, kCell_m = 0.010;

struct Arguments {
  std::string data, only, out = "out/motion";
  std::vector<std::string> motions = {"walk", "reach", "run", "dance", "sit", "squat", "arms-up"};
  int frames = 13, refits = 4;
  std::size_t points = 6000, particles = 20000;
  bool peers = true, prepared = false;
};

struct Subject {
  std::string name;
  tryon::PreparedBody body;
};

Subject prepare(const engine::Context& context, const std::string& file, bench::BodyResult& result) {
  const tryon::BodySource source =
      file.empty() ? tryon::BodySource(synth::BodyOptions{}) : tryon::BodySource(tryon::BodyFile{file});
  tryon::SegmentedSkin skin = file.empty() ? bench::or_exit(tryon::segment_builtin(context, {}, {}))
                                           : bench::or_exit(tryon::segment_file(context, file, {}));
  bench::or_exit(tryon::give_rig(context, source, skin));
  Subject subject{file.empty() ? "built-in" : std::filesystem::path(file).stem().string(),
                  bench::or_exit(tryon::fit_bound_proxy(context, std::move(skin), {}))};
  const proxy::BodyProxy& bound = subject.body.fit.proxy;
  proxy::BodyProxy::Data data = bound.data();
  data.binding = nullptr;
  const proxy::BodyProxy rest = bench::or_exit(proxy::BodyProxy::make(std::move(data)));
  const bench::Stopwatch watch;
  const rig::Rig& rig = *subject.body.skin.rig;
  bench::or_exit(binding::bind(
      {}, rest, {subject.body.skin.input.skin, rig.skeleton, rig.weights, subject.body.skin.anatomy.part}));
  result = {subject.name,
            subject.body.skin.input.skin.positions.size(),
            bound.ellipsoids().size(),
            watch.cpu_ms(),
            static_cast<double>(rest.bytes()),
            static_cast<double>(bound.binding()->bytes())};
  return subject;
}

/// The joint that moves each vertex most.
std::vector<std::uint16_t> main_joints(const rig::SkinWeights& weights) {
  std::vector<std::uint16_t> joint;
  for (std::size_t v = 0; v < weights.vertices(); ++v) {
    const auto begin = weights.weight.begin() + weights.first[v],
               end = weights.weight.begin() + weights.first[v + 1];
    joint.push_back(
        weights.joint[static_cast<std::size_t>(std::max_element(begin, end) - weights.weight.begin())]);
  }
  return joint;
}

std::vector<std::unique_ptr<bench::MovingPeer>> peers_of(const tryon::PreparedBody& body) {
  const geometry::TriMesh& skin = body.skin.input.skin;
  const rig::Rig& rig = *body.skin.rig;
  std::vector<std::unique_ptr<bench::MovingPeer>> peers;
  peers.push_back(bench::rigid_capsules(skin, main_joints(rig.weights), rig.skeleton.joints.size()));
  if (auto embree = bench::embree_refit(skin, kReach_m)) peers.push_back(std::move(embree));
  peers.push_back(bench::rebuilt_grid(skin, kCell_m));
  return peers;
}

bench::MethodResult judge(bench::MovingPeer& method, const bench::Frames& frames,
                          const std::vector<bench::Truth>& truths, std::size_t step) {
  bench::MethodResult result;
  result.name = method.name();
  for (std::size_t i = 0; i < frames.size(); i += step) {
    method.pose(frames.at(i));
    std::vector<float> distance_m(truths[i].particles.size());
    method.query(truths[i].particles, distance_m);
    result.judge.add(truths[i], distance_m);
    result.time_s.push_back(frames.time_s[i]);
  }
  result.bytes = method.bytes();
  result.knows_depth = method.knows_depth();
  return result;
}

bench::MotionResult measure(const engine::Context& context, const Subject& subject,
                            const tryon::BodyMotion& motion, const std::string& name,
                            const Arguments& arguments) {
  const tryon::PreparedBody& body = subject.body;
  const bench::Frames frames = bench::frames_of(body.skin, motion, arguments.frames);
  const bench::TruePoints points(body.skin.input.skin, arguments.points);
  std::vector<bench::Truth> truths;
  for (const geometry::TriMesh& skin : frames.skin) truths.push_back(points.in_pose(context, skin));

  bench::MotionResult result;
  result.body = subject.name, result.motion = name;
  bench::PosedProxy carried(body, false), refit(body, true);
  result.methods.push_back(judge(carried, frames, truths, 1));
  result.methods.back().cost = bench::cost_of(carried, frames, body.skin, arguments.particles, 3);
  // The clip's first, last and middle frames are among those refitted.
  const auto step =
      std::max<std::size_t>(1, (frames.size() - 1) / static_cast<std::size_t>(arguments.refits));
  result.methods.push_back(judge(refit, frames, truths, step));
  result.methods.back().cost = result.methods.front().cost;  // a refitted proxy is posed and queried alike
  std::vector<double> refit_ms = refit.refit_ms();
  std::ranges::sort(refit_ms);
  result.refit_ms = refit_ms[refit_ms.size() / 2];
  bench::PosedProxy covering = bench::PosedProxy::covering(body);
  result.methods.push_back(judge(covering, frames, truths, 1));
  result.methods.back().cost = bench::cost_of(covering, frames, body.skin, arguments.particles, 3);
  if (arguments.prepared) {
    const proxy::BasePoses bases =
        bench::or_exit(tryon::make_base_poses(context, body.fit.proxy, body.skin, motion));
    bench::PosedProxy prepared(body, bases);
    result.methods.push_back(judge(prepared, frames, truths, 1));
    result.methods.back().cost = bench::cost_of(prepared, frames, body.skin, arguments.particles, 3);
  }
  if (arguments.peers)
    for (const auto& peer : peers_of(body)) {
      result.methods.push_back(judge(*peer, frames, truths, 1));
      result.methods.back().cost = bench::cost_of(*peer, frames, body.skin, arguments.particles / 4, 2);
    }
  result.cost = bench::proxy_cost(body, frames, arguments.particles);
  return result;
}

/// The motions of the arguments, and the clips of the body's own file.
std::vector<bench::MotionResult> measure_all(const engine::Context& context, const Subject& subject,
                                             const Arguments& arguments) {
  std::vector<bench::MotionResult> results;
  std::vector<engine::Warning> warnings;
  const rig::Rig& rig = *subject.body.skin.rig;
  for (const std::string& name : arguments.motions) {
    const tryon::BodyMotion motion = bench::or_exit(
        tryon::find_motion(context, subject.body.skin, {.motion = name, .clip = {}}, warnings));
    results.push_back(measure(context, subject, motion, name, arguments));
    bench::print_motion(results.back());
  }
  for (const rig::Clip& clip : rig.clips) {
    results.push_back(measure(context, subject, {rig, clip}, "clip " + clip.name, arguments));
    bench::print_motion(results.back());
  }
  return results;
}

std::vector<std::string> files_of(const Arguments& arguments) {
  std::vector<std::string> files;
  if (arguments.data.empty()) return {std::string()};
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(arguments.data) / "rigs"))
    if (entry.path().extension() == ".glb" &&
        entry.path().stem().string().find(arguments.only) != std::string::npos)
      files.push_back(entry.path().string());
  std::ranges::sort(files);
  return files;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app{"Error and cost of a proxy that moves, beside capsules, Embree and a distance grid."};
  app.add_option("--data", arguments.data, "folder: its rigs/*.glb are measured; the built-in body without");
  app.add_option("--only", arguments.only, "a part of the names of the rigs to measure");
  app.add_option("--motion", arguments.motions, "motions to measure")->delimiter(',')->capture_default_str();
  app.add_option("--frames", arguments.frames, "frames of each clip, evenly over its time")
      ->check(CLI::Range(2, 1000))
      ->capture_default_str();
  app.add_option("--refits", arguments.refits, "frames of each clip that are refitted")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--points", arguments.points, "points near the skin in each frame")->capture_default_str();
  app.add_option("--particles", arguments.particles, "particles of a timed query")->capture_default_str();
  app.add_flag("!--no-peers", arguments.peers, "measure the proxy alone");
  app.add_flag("--prepared", arguments.prepared, "measure the proxy with base poses along each clip, too");
  app.add_option("--out", arguments.out, "folder for motion.json and motion.png")->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  const auto workers = engine::make_tbb_executor();
  const engine::Context context{.executor = workers.get()};
  std::vector<bench::BodyResult> bodies;
  std::vector<bench::MotionResult> motions;
  for (const std::string& file : files_of(arguments)) {
    const Subject subject = prepare(context, file, bodies.emplace_back());
    for (bench::MotionResult& result : measure_all(context, subject, arguments))
      motions.push_back(std::move(result));
  }
  if (motions.empty()) {
    std::fprintf(stderr, "%s/rigs has no rig that --only '%s' names.\n", arguments.data.c_str(),
                 arguments.only.c_str());
    return 1;
  }
  bench::print_bars(bodies, motions);
  std::filesystem::create_directories(arguments.out);
  const std::filesystem::path out = arguments.out;
  const bool numbers = bench::write_json(bodies, motions, out / "motion.json");
  const bool written = bench::write_plot(motions, out / "motion.png") && numbers;
  if (written) std::printf("\n%s\n%s\n", (out / "motion.json").c_str(), (out / "motion.png").c_str());
  return written ? 0 : 1;
}
