// A small host with a loop of its own at 60 Hz: a skirt on a body, and other bodies while the frames run. It
// prints what a runtime would show, and writes a strip of pictures for each body.
//
//   the host's loop     |frame|frame|frame|frame|frame|frame|frame|frame|frame|   16.7 ms each
//   the live proxy       A coarse     |A fine             |B coarse   |B fine     between two frames only
//   beside the frames    |prepare A ........|              |prepare B ......|
//
//     tryon_runtime [BODY FILE...]     no files: two built-in bodies; strip_1.png, strip_2.png, ...
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include <bodice/io/scene.hpp>
#include <bodice/tryon/session.hpp>
#include <bodice/tryon/wearing.hpp>

using namespace bodice;

namespace {

constexpr double kFrame_s = 1.0 / 60.0;
constexpr int kFramesAfter = 90;   ///< frames shown once a body is ready
constexpr int kPictureEvery = 15;  ///< frames from picture to picture
constexpr int kMostFrames = 7200;  ///< two minutes: a body that takes longer does not come

/// The mean distance of the skin's vertices from the live proxy, millimeters.
double error_mm(const engine::Context& context, const tryon::Session& session) {
  const collision::Collider& collider = *session.collider();
  std::vector<float> x, y, z;
  for (const geometry::Vec3& p : session.body()->skin->input.skin.positions) {
    const Eigen::Vector3f local = (p - collider.origin()).cast<float>();
    x.push_back(local.x()), y.push_back(local.y()), z.push_back(local.z());
  }
  std::vector<collision::Contact> contacts(x.size());
  collision::Workspace workspace;
  collider.query(context, {x.size(), x.data(), y.data(), z.data()}, contacts, workspace);
  double sum = 0.0;
  for (const collision::Contact& contact : contacts) sum += std::abs(double{contact.signed_distance});
  return 1e3 * sum / static_cast<double>(contacts.size());
}

/// Frame times since the last line, and that line.
class Dashboard {
 public:
  void add(double ms) { ms_.push_back(ms); }
  void print(const engine::Context& context, const tryon::Session& session, int frame, std::size_t body) {
    std::ranges::sort(ms_);
    std::printf("frame %4d   %5.2f ms, slowest %5.2f   ", frame, ms_[ms_.size() / 2], ms_.back());
    if (const tryon::LiveBody* live = session.body())
      std::printf("body %zu, proxy %d: %3zu ellipsoids, %016llx, %.2f mm from the skin\n", body,
                  live->refinement, live->proxy.ellipsoids().size(),
                  static_cast<unsigned long long>(live->proxy.hash()), error_mm(context, session));
    else
      std::puts("no body yet");
    ms_.clear();
  }
  bool empty() const { return ms_.empty(); }

 private:
  std::vector<double> ms_;
};

/// Pictures of one body and what it wears, as one strip.
class Strip {
 public:
  void add(const tryon::Session& session, const geometry::TriMesh& garment, double time_s) {
    if (track_.frames.empty()) {
      track_ = {.name = "skirt", .mesh = garment};
      skin_ = session.body()->skin;
    }
    track_.frames.emplace_back(session.vertices());
    session.positions(track_.frames.back());
    track_.time_s.push_back(time_s);
  }
  engine::Result<void> write(const std::string& file) {
    io::Scene scene;
    scene.body = &skin_->input.skin;
    scene.part = skin_->anatomy.part;
    std::vector<std::size_t> frames;
    for (std::size_t f = 0; f < track_.frames.size(); f += std::max<std::size_t>(1, track_.frames.size() / 8))
      frames.push_back(f);
    scene.garments.push_back(std::move(track_));
    track_ = {};
    auto saved = io::write_contact_sheet(scene, frames, static_cast<int>(frames.size()), file,
                                         {.width = 160, .height = 320});
    if (saved) std::printf("wrote %s\n", file.c_str());
    return saved;
  }
  bool empty() const { return track_.frames.empty(); }

 private:
  io::GarmentTrack track_;
  std::shared_ptr<const tryon::SegmentedSkin> skin_;
};

/// The bodies that are tried on, and the session that shows them.
class Host {
 public:
  Host(const engine::Context& context, std::span<char*> files)
      : context_(context), session_(context, {.fit = {.tier = proxy::Tier::kRelief}}) {
    for (const char* file : files) bodies_.push_back(tryon::BodyFile{file});
    if (files.empty()) {
      bodies_.push_back(synth::BodyOptions{.vertices = 4500});
      bodies_.push_back(synth::BodyOptions{.sex = body::Sex::kMale, .stature_m = 1.75, .vertices = 4500});
    }
  }

  engine::Result<void> run() {
    auto next_display = std::chrono::steady_clock::now();
    for (int frame = 0; frame < kMostFrames; ++frame) {
      std::this_thread::sleep_until(next_display += std::chrono::microseconds(16667));
      if (auto shown = show(frame); !shown || over_) return shown;
    }
    return engine::Error{engine::ErrorCode::kCanceled, "A body was not ready within two minutes.",
                         "Give another one."};
  }

 private:
  engine::Result<void> show(int frame) {
    if (submitted_ == 0) submit();
    const auto begin = std::chrono::steady_clock::now();
    const tryon::FrameOutcome outcome = session_.frame(kFrame_s);
    board_.add(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
    if (!outcome.has_body) session_.pipeline().run_pending();  // for an executor without a worker to spare
    if (outcome.has_body && !garment_) {
      auto skirt = tryon::make_garment(context_, *session_.body()->skin);
      if (!skirt) return std::move(skirt).error();
      garment_ = std::move(skirt).value();
      if (auto worn = session_.dress({*garment_}); !worn) return worn;
    }
    if (session_.body() && session_.body()->skin != live_) {
      if (auto saved = end_strip(); !saved) return saved;
      live_ = session_.body()->skin;
      ++shown_;
    }
    if (garment_ && frame % kPictureEvery == 0) strip_.add(session_, garment_->mesh, frame * kFrame_s);
    if (frame % 30 == 29 || outcome.proxy_hash != hash_) board_.print(context_, session_, frame, shown_);
    hash_ = outcome.proxy_hash;
    return ticket_.done() ? after_ready() : engine::Result<void>();
  }

  void submit() { ticket_ = session_.submit(bodies_[submitted_++]); }

  /// Goes on to the next body when this one was shown for a while.
  engine::Result<void> after_ready() {
    if (auto prepared = ticket_.wait(); !prepared) return prepared;
    if (++ready_for_ < kFramesAfter) return {};
    ready_for_ = 0;
    over_ = submitted_ == bodies_.size();
    if (over_) return end_strip();
    submit();
    return {};
  }

  engine::Result<void> end_strip() {
    return strip_.empty() ? engine::Result<void>() : strip_.write("strip_" + std::to_string(shown_) + ".png");
  }

  const engine::Context& context_;
  tryon::Session session_;
  std::vector<tryon::BodySource> bodies_;
  std::size_t submitted_ = 0, shown_ = 0;
  engine::Ticket ticket_;
  std::optional<tryon::WornGarment> garment_;
  std::shared_ptr<const tryon::SegmentedSkin> live_;
  Dashboard board_;
  Strip strip_;
  std::uint64_t hash_ = 0;
  int ready_for_ = 0;
  bool over_ = false;
};

}  // namespace

int main(int argc, char** argv) {
  const auto workers = engine::make_tbb_executor();
  const engine::Context context{.executor = workers.get()};
  Host host(context, std::span(argv, static_cast<std::size_t>(argc)).subspan(1));
  if (auto shown = host.run(); !shown) return std::printf("%s\n", shown.error().sentence().c_str()), 1;
  return 0;
}
