#include "batch/batch_work.hpp"

#include <filesystem>
#include <utility>

#include <bodice/engine/stage_timer.hpp>
#include <bodice/io/import.hpp>
#include <bodice/proxy/base_pose.hpp>
#include <bodice/rigging/motion.hpp>

#include "batch/batch_options.hpp"
#include "options/garment_kinds.hpp"

namespace bodice::inline v0_1::cli {
namespace {

namespace fs = std::filesystem;
constexpr double kMm = 1e3;  // in a meter

double seconds_of(const std::vector<engine::StageTime>& stages) {
  double ms = 0.0;
  for (const engine::StageTime& stage : stages) ms += stage.ms;
  return 1e-3 * ms;
}

/// A body with its proxy, which each job dresses in a process of its own.
class PreparedBodies : public batch::PreparedJobs {
 public:
  PreparedBodies(tryon::PreparedBody body, int threads) : body_(std::move(body)), threads_(threads) {}

  engine::Result<batch::JobFacts> run(const batch::Job& job, const fs::path& folder) override {
    auto command = command_of(job);
    if (!command) return std::move(command).error();
    CommonOptions& o = command->common;
    o.threads = threads_;
    for (std::string* file : {&o.labels, &o.html, &o.picture, &o.trace, &command->contact_sheet,
                              &command->film_strip, &command->cache})
      if (!file->empty()) *file = (folder / *file).string();
    o.report = (folder / "report.json").string();
    command->output = (folder / "drape.glb").string();
    command->thumbnail = (folder / "thumbnail.png").string();
    Run run(o);
    const fs::path proxy = folder / "proxy.bodice";
    if (auto saved = proxy::save_with_bases({body_.fit.proxy, {}}, proxy); !saved)
      return std::move(saved).error();
    batch::JobFacts facts{.seed = o.seed, .warnings = {}, .numbers = {}};
    auto done = only_fits(job) ? write_fit(run, *command, folder, facts) : drape(run, *command, facts);
    if (!done) return std::move(done).error();
    return facts;
  }

 private:
  void add_fit_facts(batch::JobFacts& facts) const {
    const fitting::FitAccuracy& accuracy = body_.fit.accuracy;
    const std::vector<engine::Warning> warnings = body_.all_warnings();
    facts.warnings.insert(facts.warnings.end(), warnings.begin(), warnings.end());
    facts.numbers = {{"ellipsoids", static_cast<double>(body_.fit.proxy.ellipsoids().size())},
                     {"gap_mean_mm", kMm * accuracy.gap_m.mean},
                     {"gap_p95_mm", kMm * accuracy.gap_m.p95},
                     {"gap_max_mm", kMm * accuracy.gap_m.max}};
  }

  engine::Result<void> write_fit(Run& run, const DrapeCommand& command, const fs::path& folder,
                                 batch::JobFacts& facts) {
    const io::Scene scene = scene_of(body_);
    if (auto saved = io::write_glb(scene, folder / "body.glb"); !saved) return saved;
    if (const std::string& file = command.common.picture; !file.empty())
      if (auto saved = io::write_picture(scene, {}, file, {.show_proxy = true}); !saved) return saved;
    io::PictureOptions picture = kThumbnail;
    picture.show_proxy = true;
    if (auto saved = io::write_picture(scene, {}, command.thumbnail, picture); !saved) return saved;
    std::vector<std::string> written;
    if (auto done = run.write_page(body_, scene, nullptr, written); !done) return done;
    add_fit_facts(facts);
    facts.numbers.emplace_back("error_mm", kMm * body_.fit.accuracy.gap_m.max);
    return run.finish(body_, nullptr, written);
  }

  engine::Result<void> drape(Run& run, const DrapeCommand& command, batch::JobFacts& facts) {
    auto motion = find_motion(run, command, body_.skin);
    if (!motion) return std::move(motion).error();
    std::vector<engine::StageTime> stages;
    auto worn = [&] {
      const engine::StageTimer timer(run.context(), stages, "dress");
      return dress(run, command, body_.skin);
    }();
    if (!worn) return std::move(worn).error();
    auto props = [&] {
      const engine::StageTimer timer(run.context(), stages, "props");
      return read_props(run, command, body_);
    }();
    if (!props) return std::move(props).error();
    // The process runs a single job, so that it may move the shared body.
    DressedBody dressed{std::move(body_), std::move(motion).value(), std::move(worn).value(),
                        std::move(props).value()};
    std::vector<std::string> written;
    const auto report = drape_and_write(run, command, dressed, written);
    body_ = std::move(dressed.body);
    if (!report) return report.error();
    add_fit_facts(facts);
    facts.warnings.insert(facts.warnings.end(), report->warnings.begin(), report->warnings.end());
    facts.numbers.insert(facts.numbers.end(),
                         {{"penetration_max_mm", kMm * report->penetration_max_m},
                          {"penetration_end_mm", kMm * report->penetration_end_m},
                          {"over_1mm", static_cast<double>(report->penetration_over_1mm)},
                          {"stretch_p95_percent", 100.0 * report->stretch_p95},
                          {"frame_ms", report->frame_ms_median},
                          {"dress_s", seconds_of(stages)},
                          {"drape_s", seconds_of(report->stages)},
                          {"error_mm", kMm * report->penetration_max_m}});
    return run.finish(body_, &*report, written);
  }

  tryon::PreparedBody body_;
  int threads_;
};

}  // namespace

DrapeWork::DrapeWork(int threads) : threads_(threads) {
  CLI::App options;
  CommonOptions common;
  add_common_options(options, common);
  of_fits_ = names_of_options(options);
  of_fits_.insert(kBodyKey);
  of_fits_.insert(kOnlyKey);
}

std::string DrapeWork::version() const {
  return BODICE_PROGRAM;
}

bool DrapeWork::is_file(const std::string& name, const std::string& value) const {
  if (name == kBodyKey || name == "region_of" || name == "prop") return true;
  if (name == kGarmentKey) return !garment_kinds().contains(value);
  if (name == "motion") return !rigging::motion_from_name(value);
  return name == "profile" && value.ends_with(".json");
}

std::vector<fs::path> DrapeWork::files_beside(const fs::path& file) const {
  return io::files_beside(file);
}

std::string DrapeWork::shared(const batch::Job& job) const {
  std::string text = job.has("motion") ? "moves" : "";
  for (const auto& [name, values] : job.values) {
    if (!of_fits_.contains(name)) continue;
    text += '\n' + name;
    for (const std::string& value : values) text += '\t' + value;
  }
  return text;
}

engine::Result<void> DrapeWork::check(const batch::Job& job) const {
  if (auto command = command_of(job); !command) return std::move(command).error();
  return {};
}

engine::Result<std::unique_ptr<batch::PreparedJobs>> DrapeWork::prepare(const batch::Job& first) {
  auto command = command_of(first);
  if (!command) return std::move(command).error();
  command->common.threads = 1;
  command->common.trace.clear();
  Run run(command->common);
  auto skin = read_body(run, *command);
  if (!skin) return std::move(skin).error();
  auto body = fit_body(run, std::move(skin).value(), only_fits(first) || command->moves());
  if (!body) return std::move(body).error();
  return std::unique_ptr<batch::PreparedJobs>(
      std::make_unique<PreparedBodies>(std::move(body).value(), threads_));
}

}  // namespace bodice::cli
