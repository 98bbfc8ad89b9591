// The paper's own experiments again, into a folder: Table 2 as table2.csv and paper.md.
// Usage: paper [--out FOLDER] [--data FOLDER] [--quick]
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

#include <bodice/io/files.hpp>

#include "bodies.hpp"
#include "table2.hpp"

namespace {

namespace pb = paper_bench;
using bodice::engine::Result;

struct Arguments {
  std::filesystem::path out = "paper", data;
  bool quick = false;
};

bool parse(int argc, char** argv, Arguments& arguments) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--quick")
      arguments.quick = true;
    else if (word == "--out" && i + 1 < argc)
      arguments.out = argv[++i];
    else if (word == "--data" && i + 1 < argc)
      arguments.data = argv[++i];
    else
      return false;
  }
  return true;
}

Result<void> run(const Arguments& arguments) {
  std::filesystem::create_directories(arguments.out);
  const auto bodies = pb::four_bodies(arguments.data);
  if (!bodies) return bodies.error();
  const pb::Effort effort = arguments.quick ? pb::Effort{1, 4000} : pb::Effort{};
  std::vector<pb::Table2Row> rows;
  for (const pb::Subject& body : *bodies) {
    std::fprintf(stderr, "Table 2: %s\n", body.paper.body);
    auto row = pb::measure_table2(body, effort);
    if (!row) return row.error();
    rows.push_back(std::move(*row));
  }
  if (auto ok = bodice::io::write_file(arguments.out / "table2.csv", pb::table2_csv(rows)); !ok) return ok;
  return bodice::io::write_file(arguments.out / "paper.md", pb::table2_markdown(rows));
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  if (!parse(argc, argv, arguments)) {
    std::fputs("usage: paper [--out FOLDER] [--data FOLDER] [--quick]\n", stderr);
    return 2;
  }
  if (const auto done = run(arguments); !done) {
    std::fprintf(stderr, "paper: %s\n", done.error().sentence().c_str());
    return 1;
  }
  return 0;
}
