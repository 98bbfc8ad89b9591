// What of the machine a batch may use.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>

#include <sched.h>
#include <unistd.h>

#include <bodice/batch/batch.hpp>

namespace bodice::inline v0_1::batch {
namespace {

/// The folder of this process's control group (version 2), and those above it, are looked at in turn.
template <class Look>
void for_each_group(Look look) {
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    if (!line.starts_with("0::")) continue;
    std::string path = line.substr(3);
    for (;;) {
      look("/sys/fs/cgroup" + path + "/");
      if (path.empty() || path == "/") return;
      path.erase(path.rfind('/'));
    }
  }
}

/// Cores that control groups grant; infinite where they grant all.
double granted_cores() {
  double cores = HUGE_VAL;
  for_each_group([&cores](const std::string& folder) {
    std::ifstream file(folder + "cpu.max");
    double quota = 0.0, period = 0.0;  // "max 100000" where there is no limit
    if (file >> quota >> period && period > 0.0) cores = std::min(cores, quota / period);
  });
  double quota = -1.0, period = 0.0;
  std::ifstream("/sys/fs/cgroup/cpu/cpu.cfs_quota_us") >> quota;
  std::ifstream("/sys/fs/cgroup/cpu/cpu.cfs_period_us") >> period;
  if (quota > 0.0 && period > 0.0) cores = std::min(cores, quota / period);
  return cores;
}

/// Memory that is free, or that the system can free at once; 0 if it is not known.
double available_memory_mb() {
  double available_mb = 0.0;
  std::ifstream file("/proc/meminfo");
  for (std::string name; file >> name;) {
    double kib = 0.0;
    if (name == "MemAvailable:" && file >> kib) available_mb = kib * 1024e-6;
    std::getline(file, name);
  }
  for_each_group([&available_mb](const std::string& folder) {
    double most = 0.0, used = 0.0;  // "max" where there is no limit
    std::ifstream limit(folder + "memory.max"), usage(folder + "memory.current");
    if (limit >> most && usage >> used) available_mb = std::min(available_mb, (most - used) * 1e-6);
  });
  return available_mb;
}

}  // namespace

int available_cores() {
  double cores = static_cast<double>(std::max(1L, ::sysconf(_SC_NPROCESSORS_ONLN)));
  cpu_set_t bound;
  if (::sched_getaffinity(0, sizeof bound, &bound) == 0) cores = CPU_COUNT(&bound);
  cores = std::min(cores, std::ceil(granted_cores()));
  if (const char* granted = std::getenv("SLURM_CPUS_PER_TASK"); granted && std::atoi(granted) > 0)
    cores = std::min(cores, static_cast<double>(std::atoi(granted)));
  return std::max(1, static_cast<int>(cores));
}

int jobs_side_by_side(int workers_a_job, double memory_mb) {
  int jobs = std::max(1, available_cores() / std::max(1, workers_a_job));
  const double available_mb = available_memory_mb();
  if (memory_mb > 0.0 && available_mb > 0.0)
    jobs = std::min(jobs, static_cast<int>(std::max(1.0, available_mb / memory_mb)));
  return jobs;
}

}  // namespace bodice::batch
