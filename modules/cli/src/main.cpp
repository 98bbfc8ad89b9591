// The program `bodice`: parses, calls the library, prints.

#include <cstdio>
#include <exception>

#include "options/options.hpp"
#include "output/terminal.hpp"

namespace {

/// The names of all commands, in the order of the help.
std::string commands(const CLI::App& app) {
  std::string names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names += (names.empty() ? "" : ", ") + command->get_name();
  return names;
}

void describe(CLI::App& app) {
  app.set_version_flag("--version", BODICE_PROGRAM);
  app.require_subcommand(1);
  app.footer(
      "Try:  bodice drape                     the built-in body and skirt, no files needed\n"
      "      bodice fit body.obj -o p.json    a proxy for your body\n"
      "      bodice fit --help                every option of a command\n"
      "Exit status: 0 ok, 1 failed, 2 bad usage.");
  app.failure_message([](const CLI::App* parsed, const CLI::Error& error) {
    std::string program = "bodice";
    for (const CLI::App* command : parsed->get_subcommands()) program += " " + command->get_name();
    return std::string("bodice: ") + error.what() + ". See `" + program + " --help`.\n";
  });
}

/// Parses the command line, which runs the command that it names; that sets `exit_code`. Returns the exit
/// status.
int parse_and_run(CLI::App& app, int argc, char** argv, const int& exit_code) {
  using namespace bodice::cli;
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::RequiredError& error) {
    if (argc > 1 && argv[1][0] != '-' && app.get_subcommands().empty())
      return fail({bodice::engine::ErrorCode::kInvalidArgument,
                   std::string("There is no command '") + argv[1] + "'.",
                   "Commands are " + commands(app) + "."});
    app.exit(error);
    return kExitUsage;
  } catch (const CLI::ParseError& error) {
    app.exit(error);
    return kExitUsage;
  } catch (const std::exception& error) {
    return fail({bodice::engine::ErrorCode::kInternal,
                 std::string("Unexpected failure: ") + error.what() + ".",
                 "Please report it with the input that caused it."});
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace bodice::cli;
  CLI::App app{"bodice turns a human body mesh into a small analytic proxy and keeps cloth out of it."};
  describe(app);
  int exit_code = kExitOk;
  const std::vector<std::string> command_line(argv, argv + argc);
  add_fit_command(app, exit_code, command_line);
  add_drape_command(app, exit_code, command_line);
  add_make_command(app, exit_code);
  add_rig_command(app, exit_code);
  add_query_command(app, exit_code);
  add_export_command(app, exit_code);
  add_report_command(app, exit_code);
  add_batch_command(app, exit_code);
  add_bench_command(app, exit_code, argv[0]);
  exit_code = parse_and_run(app, argc, argv, exit_code);
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    return fail({bodice::engine::ErrorCode::kWriteFailed, "Standard output cannot be written to its end.",
                 "Free some room on the disk, or print to another file."});
  return exit_code;
}
