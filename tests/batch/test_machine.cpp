// Cores and memory that a batch may use.
#include <doctest/doctest.h>

#include <cstdlib>

#include <sched.h>

#include <bodice/batch/batch.hpp>

using namespace bodice;

TEST_CASE("a batch takes the cores that it is bound to or granted, and no more jobs than memory holds") {
  cpu_set_t before;
  REQUIRE(::sched_getaffinity(0, sizeof before, &before) == 0);
  const int all = batch::available_cores();
  CHECK(all >= 1);
  CHECK(all <= CPU_COUNT(&before));
  CHECK(batch::jobs_side_by_side(1, 0.0) == all);
  CHECK(batch::jobs_side_by_side(1000, 0.0) == 1);
  CHECK(batch::jobs_side_by_side(1, 1e9) == 1);

  REQUIRE(::setenv("SLURM_CPUS_PER_TASK", "1", 1) == 0);
  CHECK(batch::available_cores() == 1);
  REQUIRE(::unsetenv("SLURM_CPUS_PER_TASK") == 0);

  cpu_set_t one;
  CPU_ZERO(&one);
  for (std::size_t core = 0; core < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++core)
    if (CPU_ISSET(core, &before)) CPU_SET(core, &one);
  REQUIRE(::sched_setaffinity(0, sizeof one, &one) == 0);
  CHECK(batch::available_cores() == 1);
  REQUIRE(::sched_setaffinity(0, sizeof before, &before) == 0);
}
