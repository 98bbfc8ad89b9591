#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>

#include <bodice/engine/executor.hpp>
#include <bodice/engine/text.hpp>
#include <bodice/engine/write_file.hpp>
#include <bodice/io/import.hpp>
#include <bodice/io/scene_file.hpp>
#include <bodice/page/page.hpp>
#include <bodice/proxy/base_pose.hpp>

#include "options/options.hpp"
#include "options/validators.hpp"
#include "output/outputs.hpp"
#include "output/terminal.hpp"

namespace bodice::inline v0_1::cli {
namespace {

namespace fs = std::filesystem;
using engine::Error;
using engine::ErrorCode;

struct ReportCommand {
  std::vector<std::string> inputs;
  std::string output, body;
  bool quiet = false;
};

/// What the files of one run hold.
struct RunFiles {
  std::string proxy_file, glb_file, report_file, trace_file;  ///< empty where there is none
  std::optional<proxy::BodyProxy> proxy;
  std::optional<io::SceneFile> scene;
  std::optional<page::PageSubject> report;
  std::vector<page::TaskSpan> tasks;
  std::optional<geometry::TriMesh> body;
};

std::string beginning_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text(200, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Keeps the name of the one file of its kind.
engine::Result<void> take(std::string& kept, const std::string& file, const char* kind) {
  if (!kept.empty())
    return Error{ErrorCode::kInvalidArgument,
                 "There are two " + std::string(kind) + ": " + kept + " and " + file + ".",
                 "A page shows one run: name its files alone."};
  kept = file;
  return {};
}

/// Finds by content which of the four kinds a file is.
engine::Result<void> add_file(const std::string& file, RunFiles& run) {
  const std::string text = beginning_of(file);
  if (text.starts_with("glTF")) return take(run.glb_file, file, "GLBs");
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  const bool object = first != std::string::npos && text[first] == '{';
  if (object && text.find("\"traceEvents\"") != std::string::npos)
    return take(run.trace_file, file, "traces");
  if (object && text.find("\"format\"") == std::string::npos) return take(run.report_file, file, "reports");
  return take(run.proxy_file, file, "proxies");
}

/// The files of a result of batch.
engine::Result<void> add_folder(const fs::path& folder, RunFiles& run) {
  bool any = false;
  for (const char* name : {"proxy.bodice", "report.json", "drape.glb", "body.glb"}) {
    std::error_code ignored;
    if (!fs::is_regular_file(folder / name, ignored)) continue;
    any = true;
    if (auto added = add_file((folder / name).string(), run); !added) return added;
  }
  if (any) return {};
  return Error{ErrorCode::kNotFound,
               "The folder " + folder.string() + " holds no result: no proxy.bodice, report.json or GLB.",
               "Name a folder that bodice batch made, or files."};
}

engine::Result<void> load_run(const engine::Context& context, const ReportCommand& command, RunFiles& run) {
  if (!run.proxy_file.empty()) {
    auto both = proxy::load_with_bases(run.proxy_file);
    if (!both) return std::move(both).error();
    run.proxy = std::move(both->proxy);
  }
  if (!run.glb_file.empty()) {
    auto scene = io::read_scene_file(context, run.glb_file);
    if (!scene) return std::move(scene).error();
    run.scene = std::move(scene).value();
  }
  if (!run.report_file.empty()) {
    auto subject = page::subject_of_report(text_of(run.report_file), run.report_file);
    if (!subject) return std::move(subject).error();
    run.report = std::move(subject).value();
  }
  if (!run.trace_file.empty()) {
    auto tasks = page::tasks_of_trace(text_of(run.trace_file), run.trace_file);
    if (!tasks) return std::move(tasks).error();
    run.tasks = std::move(tasks).value();
  }
  if (command.body.empty()) return {};
  if (run.scene && !run.scene->body.empty())
    return Error{ErrorCode::kInvalidArgument, "The skin is in " + run.glb_file + " already.",
                 "Leave --body out."};
  io::ImportOptions options;
  if (run.proxy) options.up = run.proxy->frame().up;
  auto body = io::import_body(context, command.body, options);
  if (!body) return std::move(body).error();
  run.body = std::move(body->skin);
  return {};
}

/// Files of different runs would be shown as one.
engine::Result<void> check_one_run(const RunFiles& run) {
  const std::pair<std::string, std::string> known[] = {
      {run.proxy_file, run.proxy ? engine::hex64(run.proxy->hash()) : ""},
      {run.glb_file, run.scene ? run.scene->proxy_hash : ""},
      {run.report_file, run.report ? run.report->hash : ""}};
  const std::pair<std::string, std::string>* first = nullptr;
  for (const auto& file : known) {
    if (file.second.empty()) continue;
    if (!first) first = &file;
    if (file.second != first->second)
      return Error{ErrorCode::kInvalidArgument,
                   first->first + " and " + file.first + " are of two runs: their proxies are " +
                       first->second + " and " + file.second + ".",
                   "Name files of one run."};
  }
  return {};
}

std::vector<std::string> what_is_missing(const RunFiles& run, const io::Scene& scene) {
  std::vector<std::string> lacks;
  if (!scene.body)
    lacks.emplace_back(
        "There is no skin here, hence no error of it: name the GLB of the run, or the body with --body.");
  else if (!scene.proxy)
    lacks.emplace_back("The skin is not colored by its error, for which the proxy of the run is needed.");
  if (!run.report)
    lacks.emplace_back(
        "There are no landmarks, warnings, times and curves here: the report of the run holds them.");
  if (run.report && run.tasks.empty())
    lacks.emplace_back("The times have no tasks: the trace of the run holds them.");
  if (run.report && run.report->drape && scene.garments.empty())
    lacks.emplace_back("The cloth is not shown: the GLB of the run holds it.");
  if (run.report && run.report->drape && run.report->drape->penetration_mm.empty())
    lacks.emplace_back("This report has no depth of each frame.");
  return lacks;
}

io::Scene scene_of_files(RunFiles& run) {
  io::Scene scene;
  scene.proxy = run.proxy ? &*run.proxy : nullptr;
  if (run.body) scene.body = &*run.body;
  if (!run.scene) return scene;
  io::SceneFile& file = *run.scene;
  if (!file.body.empty()) scene.body = &file.body, scene.part = file.part;
  scene.body_frames = file.body_frames;
  scene.garments = std::move(file.garments);
  const std::size_t shapes = scene.proxy ? scene.proxy->ellipsoids().size() : file.ellipsoids.size();
  if (file.ellipsoids.size() == shapes) scene.proxy_frames = file.ellipsoid_frames;
  return scene;
}

std::string title_of(const RunFiles& run) {
  const std::string& file = !run.glb_file.empty()     ? run.glb_file
                            : !run.proxy_file.empty() ? run.proxy_file
                                                      : run.trace_file;
  return fs::path(file).filename().string();
}

engine::Result<void> write_report_page(const ReportCommand& command) {
  RunFiles run;
  for (const std::string& input : command.inputs) {
    std::error_code ignored;
    if (!fs::exists(input, ignored))
      return Error{ErrorCode::kNotFound, "'" + input + "' does not exist.", "Check its name."};
    auto added = fs::is_directory(input, ignored) ? add_folder(input, run) : add_file(input, run);
    if (!added) return added;
  }
  std::vector<FileOption> inputs = {{"--body", command.body}};
  for (const std::string& file : {run.proxy_file, run.glb_file, run.report_file, run.trace_file})
    inputs.push_back({"WHAT", file});
  const FileOption outputs[] = {{"-o", command.output, {".html"}}};
  if (auto ok = check_outputs(outputs, inputs); !ok) return ok;
  const auto executor = engine::make_tbb_executor(0);
  engine::Context context;
  context.executor = executor.get();
  if (auto loaded = load_run(context, command, run); !loaded) return loaded;
  if (auto one = check_one_run(run); !one) return one;
  const io::Scene scene = scene_of_files(run);
  page::PageSubject subject = run.report ? *run.report : page::PageSubject{};
  if (!run.report) subject.title = title_of(run);
  if (run.proxy)
    subject.tier = proxy::name(run.proxy->tier()), subject.hash = engine::hex64(run.proxy->hash());
  if (run.scene) {
    if (!run.proxy && !run.report) subject.tier = run.scene->tier, subject.hash = run.scene->proxy_hash;
    subject.ellipsoids = run.scene->ellipsoids;
  }
  subject.scene = &scene;
  subject.tasks = run.tasks;
  subject.lacks = what_is_missing(run, scene);
  const std::string page = page::page_html(context, subject);
  if (auto done = engine::write_file(command.output, std::string_view(page)); !done) return done;
  if (command.quiet) return {};
  for (const std::string& sentence : subject.lacks) std::printf("note        %s\n", sentence.c_str());
  std::printf("wrote       %s\n", command.output.c_str());
  return {};
}

}  // namespace

void add_report_command(CLI::App& app, int& exit_code) {
  auto command = std::make_shared<ReportCommand>();
  CLI::App* sub = app.add_subcommand("report", "Make a page of a saved proxy, or of a run's files");
  sub->add_option("WHAT", command->inputs,
                  "a proxy, the GLB, the report and the trace of one run, any of them in any order; or the "
                  "folder of a result of batch")
      ->check(not_empty())
      ->required();
  sub->add_option("-o,--output", command->output, "the page: one .html file that needs nothing beside it")
      ->check(not_empty())
      ->required();
  sub->add_option("--body", command->body,
                  "the body that the proxy was fitted to, where no GLB holds its skin: the page then shows "
                  "the errors of the proxy")
      ->check(not_empty());
  sub->add_flag("-q,--quiet", command->quiet, "print errors only");
  sub->footer(
      "The page is that of --html as far as the files hold it, and states what they do not.\n"
      "Example: bodice report proxy.bodice drape.glb report.json trace.json -o page.html");
  sub->callback([command, &exit_code] {
    const auto done = write_report_page(*command);
    exit_code = done ? kExitOk : fail(done.error());
  });
}

}  // namespace bodice::cli
