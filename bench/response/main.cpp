// Measures whether the response keeps its promises.
//
// Usage: response garments DATA [tier [frames [name part]]]
//        response certify [particles [seed]]
//        response creases
//        response nearest [cases [seed]]
#include <cstdio>
#include <span>
#include <string_view>

#include "modes.hpp"

int main(int argc, char** argv) {
  const std::span<char*> arguments(argv, static_cast<std::size_t>(argc));
  const std::string_view mode = argc > 1 ? argv[1] : "";
  if (mode == "garments" && argc > 2) return bench::drape_garments(arguments.subspan(2)) ? 0 : 1;
  if (mode == "certify") return bench::certify_random(arguments.subspan(2)) ? 0 : 1;
  if (mode == "creases") return bench::cross_creases(arguments.subspan(2)) ? 0 : 1;
  if (mode == "nearest") return bench::measure_nearest(arguments.subspan(2)) ? 0 : 1;
  std::puts(
      "usage: response garments DATA [tier [frames [name part]]] | certify [particles [seed]] | creases | "
      "nearest [cases [seed]]");
  return 2;
}
