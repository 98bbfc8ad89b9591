#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include <unistd.h>

#include "options/options.hpp"
#include "output/terminal.hpp"

namespace bodice::inline v0_1::cli {
namespace {

namespace fs = std::filesystem;

struct BenchCommand {
  std::string name;
  std::vector<std::string> arguments;
};

/// The folder of the benches, beside the program.
fs::path bench_folder(const std::string& program) {
  std::error_code ignored;
  const fs::path self = fs::read_symlink("/proc/self/exe", ignored);
  return (self.empty() ? fs::path(program) : self).parent_path() / "bench";
}

std::vector<std::string> available(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
    if (entry.is_regular_file() && access(entry.path().c_str(), X_OK) == 0)
      names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

int bench(const BenchCommand& command, const fs::path& folder) {
  const std::vector<std::string> names = available(folder);
  if (command.name.empty()) {
    if (names.empty())
      return fail(
          {engine::ErrorCode::kNotFound, "There are no benches in " + folder.string() + ".",
           "They stay in the build folder: configure it with BODICE_BUILD_BENCH=ON and run its bodice."});
    for (const std::string& name : names) std::puts(name.c_str());
    return kExitOk;
  }
  if (std::ranges::find(names, command.name) == names.end())
    return fail({engine::ErrorCode::kNotFound,
                 "There is no bench '" + command.name + "' in " + folder.string() + ".",
                 "Run `bodice bench` for the list, or build with BODICE_BUILD_BENCH=ON."});
  const std::string path = (folder / command.name).string();
  std::vector<char*> argv{const_cast<char*>(path.c_str())};
  for (const std::string& argument : command.arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  execv(path.c_str(), argv.data());
  return fail({engine::ErrorCode::kInternal, path + " cannot be started.", ""});
}

}  // namespace

void add_bench_command(CLI::App& app, int& exit_code, const std::string& program) {
  auto command = std::make_shared<BenchCommand>();
  CLI::App* sub = app.add_subcommand("bench", "List the benches, or run one: scaling and trade-off tables");
  sub->add_option("NAME", command->name, "the bench to run (default: list them)");
  sub->add_option("ARGUMENTS", command->arguments, "passed on to it");
  sub->prefix_command();
  sub->callback([command, sub, program, &exit_code] {
    const auto rest = sub->remaining();
    command->arguments.insert(command->arguments.end(), rest.begin(), rest.end());
    exit_code = bench(*command, bench_folder(program));
  });
}

}  // namespace bodice::cli
