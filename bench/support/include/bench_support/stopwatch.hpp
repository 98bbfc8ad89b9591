#pragma once

namespace bench {

/// Wall time, and processor time of this process.
class Stopwatch {
 public:
  Stopwatch();
  double wall_ms() const;
  double cpu_ms() const;

 private:
  double wall_, cpu_;
};

}  // namespace bench
