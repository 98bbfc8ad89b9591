#include <memory>

#include <bodice/io/obj.hpp>
#include <bodice/tryon/wearing.hpp>

#include "options/garment_kinds.hpp"
#include "options/validators.hpp"
#include "run/run.hpp"

namespace bodice::inline v0_1::cli {
namespace {

struct MakeCommand {
  CommonOptions common;
  std::string output = "body.obj", garment, kind = "skirt";
};

engine::Result<void> make(const MakeCommand& command) {
  const CommonOptions& o = command.common;
  Run run(o);
  const std::string body_out = o.body.empty() ? command.output : "";
  if (auto ok = run.check_files({{"-o", body_out, {".obj"}}, {"--garment-out", command.garment, {".obj"}}});
      !ok)
    return ok;
  auto skin = run.segment();
  if (!skin) return std::move(skin).error();
  const geometry::Frame& frame = skin->input.frame;
  std::vector<std::string> written;
  if (!body_out.empty()) {
    if (auto saved = io::write_obj(skin->input.skin, body_out, frame); !saved) return saved;
    written.push_back(body_out);
  }
  if (!command.garment.empty()) {
    auto garment = tryon::make_garment(run.context(), *skin, {.kind = garment_kinds().at(command.kind)});
    if (!garment) return std::move(garment).error();
    if (auto saved = io::write_obj(garment->mesh, command.garment, frame); !saved) return saved;
    written.push_back(command.garment);
  }
  run.list_written(written);
  return {};
}

}  // namespace

void add_make_command(CLI::App& app, int& exit_code) {
  auto command = std::make_shared<MakeCommand>();
  CLI::App* sub =
      app.add_subcommand("make", "Write the built-in body, or a garment made to fit a body, as OBJ");
  auto* body = add_body_option(*sub, command->common, "make the garment for this body");
  sub->add_option("-o,--output", command->output, "where the built-in body goes, .obj")
      ->check(not_empty())
      ->excludes(body)
      ->capture_default_str();
  auto* garment =
      sub->add_option("--garment-out", command->garment, "where the garment goes, .obj")->check(not_empty());
  body->needs(garment);
  sub->add_option("--garment", command->kind, "skirt, tunic, poncho, tube")
      ->check(CLI::IsMember({"skirt", "tunic", "poncho", "tube"}))
      ->needs(garment)
      ->capture_default_str();
  add_input_options(*sub, command->common);
  add_builtin_options(*sub, command->common);
  add_run_options(*sub, command->common);
  sub->footer("Example: bodice make -o body.obj --pose stride --garment tunic --garment-out tunic.obj");
  sub->callback([command, &exit_code] {
    const auto done = make(*command);
    exit_code = done ? kExitOk : fail(done.error());
  });
}

}  // namespace bodice::cli
