// fit [DATA] [--body NAME]... [--synth SEED]... [--tier T]... [--count N]... [a question: see --help]
// Prints CSV. Errors are those of the signed distance at points within 30 mm of the skin.
#include "questions.hpp"

int main(int argc, char** argv) {
  using namespace fit_bench;
  const Arguments arguments = read_arguments(argc, argv);
  const auto executor = bodice::engine::make_tbb_executor(arguments.threads);
  bodice::engine::Context context;
  context.executor = executor.get();
  const auto answered = [&] {
    if (arguments.bars) return print_bars(context, arguments);
    if (arguments.gap_formula) return print_gap_formula(context, arguments);
    if (arguments.anytime) return print_anytime(context, arguments);
    if (arguments.growth) return print_growth(context);
    if (!arguments.targets_mm.empty() || !arguments.budgets_us.empty())
      return print_targets(context, arguments);
    return print_front(context, arguments);
  };
  return answered() ? 0 : 1;
}
