#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>
#include <string>
#include <thread>

#include <unistd.h>

#include "measure.hpp"

namespace bodice_bench {
namespace {

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double own_cpu_s() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

// All processors together, stolen time included; 0 where there is no /proc/stat.
double machine_busy_s() {
  std::ifstream file("/proc/stat");
  std::string label;
  double user = 0, nice = 0, system = 0, idle = 0, wait = 0, irq = 0, soft = 0, steal = 0;
  file >> label >> user >> nice >> system >> idle >> wait >> irq >> soft >> steal;
  return (user + nice + system + irq + soft + steal) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

}  // namespace

Stopwatch::Stopwatch() : wall_(now_s()), cpu_(own_cpu_s()), busy_(machine_busy_s()) {}
double Stopwatch::wall_ms() const {
  return 1e3 * (now_s() - wall_);
}
double Stopwatch::cpu_ms() const {
  return 1e3 * (own_cpu_s() - cpu_);
}
double Stopwatch::others() const {
  const double others_s = machine_busy_s() - busy_ - (own_cpu_s() - cpu_);
  return std::max(0.0, others_s / ((now_s() - wall_) * std::thread::hardware_concurrency()));
}

}  // namespace bodice_bench
