// A command line, with a word a line: it is parsed or refused, and nothing else happens.
#include <algorithm>
#include <string>
#include <vector>

#include <options/options.hpp>

#include "harness.hpp"

using namespace bodice;

FUZZ_TARGET(options) {
  std::vector<std::string> words(1);
  for (const std::uint8_t byte : std::span(data, size)) {
    if (byte == '\n')
      words.emplace_back();
    else if (byte != 0)
      words.back().push_back(static_cast<char>(byte));
  }
  std::reverse(words.begin(), words.end());  // the order in which CLI11 takes them
  CLI::App app("bodice");
  cli::CommonOptions options;
  cli::add_common_options(app, options);
  try {
    app.parse(words);
  } catch (const CLI::ParseError& refused) {
    FUZZ_CHECK(refused.get_exit_code() == 0 || std::string(refused.what()).size() > 3);
    return 0;
  }
  if (!options.profile.ends_with(".json")) fuzz::check_reported(cli::segment_options(options));
  fuzz::check_reported(cli::builtin_body(options));
  static_cast<void>(cli::fit_options(options));
  return 0;
}
