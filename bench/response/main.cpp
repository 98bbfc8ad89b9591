// Measures whether the response keeps its promises.
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
      "response garments DATA [TIER [FRAMES [NAME PART]]]\n"
      "response certify [PARTICLES [SEED]]\n"
      "response creases\n"
      "response nearest [CASES [SEED]]\n"
      "Measures whether the response keeps its promises.");
  return mode == "--help" || mode == "-h" ? 0 : 2;
}
