#include "run/run.hpp"

#include <cstdio>

#include <bodice/engine/write_file.hpp>
#include <bodice/page/page.hpp>
#include <bodice/tryon/reach.hpp>

#include "output/summary.hpp"

namespace bodice::inline v0_1::cli {

Run::Run(const CommonOptions& options) : options_(options), progress_(options.quiet) {
  if (options.threads != 1) executor_ = engine::make_tbb_executor(options.threads);
  context_.executor = executor_ ? executor_.get() : &engine::inline_executor();
  if (!options.trace.empty() || !options.html.empty()) trace_ = std::make_unique<engine::Trace>();
  context_.trace = trace_.get();
}

engine::Result<void> Run::check_files(std::vector<FileOption> outputs, std::vector<FileOption> inputs) const {
  const CommonOptions& o = options_;
  outputs.insert(outputs.end(), {{"--glb", o.glb, {".glb"}},
                                 {"--picture", o.picture, {".png"}},
                                 {"--labels", o.labels},
                                 {"--report", o.report},
                                 {"--html", o.html, {".html"}},
                                 {"--trace", o.trace}});
  inputs.insert(inputs.end(), {{"BODY", o.body}, {"--region-of", o.region_of}, {"--profile", o.profile}});
  return check_outputs(outputs, inputs);
}

engine::Result<tryon::SegmentedSkin> Run::segment() {
  auto options = segment_options(options_);
  if (!options) return std::move(options).error();
  if (!options_.body.empty())
    return tryon::segment_file(context_, options_.body, *options, progress_.callback());
  auto body = builtin_body(options_);
  if (!body) return std::move(body).error();
  return tryon::segment_builtin(context_, *body, *options, progress_.callback());
}

engine::Result<tryon::SegmentedSkin> Run::segment_rigged() {
  auto skin = segment();
  if (!skin) return skin;
  tryon::BodySource source = tryon::BodyFile{options_.body};
  if (options_.body.empty()) {
    auto body = builtin_body(options_);
    if (!body) return std::move(body).error();
    source = std::move(body).value();
  }
  if (auto given = tryon::give_rig(context_, source, *skin); !given) return std::move(given).error();
  return skin;
}

engine::Result<std::vector<geometry::TriMesh>> Run::region_garments(const tryon::SegmentedSkin& skin) {
  std::vector<geometry::TriMesh> garments;
  if (options_.region_of.empty()) return garments;
  auto garment = io::import_garment(context_, options_.region_of, skin.input.frame);
  if (!garment) return std::move(garment).error();
  garments.push_back(std::move(garment->skin));
  return garments;
}

engine::Result<fitting::FitOptions> Run::fit_options_for(const tryon::SegmentedSkin& skin,
                                                         std::span<const geometry::TriMesh> garments) {
  fitting::FitOptions options = fit_options(options_);
  if (garments.empty()) return options;
  const auto reached = tryon::reachable_parts(context_, skin, garments, options_.region_margin_mm * 1e-3);
  if (!reached) return reached.error();
  options.parts = *reached;
  if (options.parts == 0)
    return engine::Error{
        engine::ErrorCode::kUnusableGeometry,
        options_.region_of + ": no part of the body is within reach of this garment.",
        "Check that both are in the same coordinates and unit, or raise --region-margin-mm."};
  return options;
}

std::string Run::report(const tryon::PreparedBody& body, const tryon::DrapeReport* drape,
                        bool cropped) const {
  return tryon::report_json(body, drape,
                            {.threads = context_.executor->concurrency(),
                             .seed = options_.seed,
                             .program = BODICE_PROGRAM,
                             .command = options_.command_line,
                             .cropped = cropped});
}

engine::Result<void> Run::write_page(const tryon::PreparedBody& body, const io::Scene& scene,
                                     const tryon::DrapeReport* drape, std::vector<std::string>& written) {
  if (options_.html.empty()) return {};
  const std::string text = page::page_html(
      context_,
      page::subject_of(
          body,
          {.scene = &scene, .drape = drape, .report = report(body, drape, false), .trace = trace_.get()}));
  if (auto done = engine::write_file(options_.html, std::string_view(text)); !done) return done;
  written.push_back(options_.html);
  return {};
}

engine::Result<void> Run::finish(const tryon::PreparedBody& body, const tryon::DrapeReport* drape,
                                 const std::vector<std::string>& written, bool cropped) {
  progress_.clear();
  std::vector<std::string> files = written;
  const std::string report = this->report(body, drape, cropped);
  auto write = [&](const std::string& file, const std::string& text) -> engine::Result<void> {
    if (file.empty()) return {};
    files.push_back(file);
    return engine::write_file(file, std::string_view(text));
  };
  if (auto done = write(options_.labels, options_.labels.empty() ? "" : tryon::labels_text(body.skin)); !done)
    return done;
  if (auto done = write(options_.report, report); !done) return done;
  if (!options_.trace.empty()) {
    files.push_back(options_.trace);
    if (auto done = trace_->write(options_.trace); !done) return done;
  }
  if (options_.json) {
    std::fputs(report.c_str(), stdout);
  } else if (!options_.quiet) {
    std::fputs(summary_text(body, drape, files, cropped).c_str(), stdout);
  }
  return {};
}

void Run::list_written(const std::vector<std::string>& files) {
  progress_.clear();
  if (options_.quiet) return;
  for (const std::string& file : files) std::printf("wrote       %s\n", file.c_str());
}

io::Scene scene_of(const tryon::PreparedBody& body) {
  io::Scene scene;
  scene.body = &body.skin.input.skin;
  scene.part = body.skin.anatomy.part;
  scene.proxy = &body.fit.proxy;
  scene.frame = body.skin.input.frame;
  return scene;
}

}  // namespace bodice::cli
