#include "page.hpp"

#include <bodice/engine/write_file.hpp>

namespace paper_bench {

Page::Page(std::filesystem::path folder, std::string command)
    : folder_(std::move(folder)), command_(std::move(command)), origin_(bench::find_origin()) {
  std::error_code ignored;  // a folder that cannot be made fails at the first file
  std::filesystem::create_directories(folder_, ignored);
  add("# The paper's experiments again");
  add("Made by `" + command_ + "`, " + bench::title(origin_) + ".");
}

void Page::write(const std::string& name, const std::string& content) {
  const auto done = bodice::engine::write_file(folder_ / name, content);
  if (!done && !failed_) failed_ = done.error();
}

void Page::add(const bench::Table& table) {
  write(table.name() + ".csv", table.csv(origin_, command_));
  add(table.caption() + " (`" + table.name() + ".csv`)\n\n" + table.markdown());
}

void Page::add(const std::string& name, bench::Plot plot) {
  plot.footer = bench::title(origin_);
  write(name + ".svg", bench::to_svg(plot));
  add("![" + plot.title + "](" + name + ".svg)");
}

bodice::engine::Result<void> Page::finish() {
  write("paper.md", text_);
  if (failed_) return *failed_;
  return {};
}

}  // namespace paper_bench
