// What is printed: a row a body, and at the end every bar beside what was measured.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "score.hpp"

namespace bench {

/// What the bodies of a run have in common: how far from the bars they are.
class Report {
 public:
  explicit Report(bool every_row, bool every_landmark)
      : every_row_(every_row), every_landmark_(every_landmark) {}

  void header() const;
  /// Prints the row if it misses a bar, or if all rows are wanted.
  void add(const Case& c, const bodice::anatomy::Anatomy& anatomy);
  void add_refused(const Case& c, const std::string& sentence);
  /// Measured values beside their bars, per landmark and in all.
  void summary() const;
  /// Whether every body was analyzed within all bars, and no more of them were doubted wrongly than may be.
  /// An awkward one may be refused instead.
  bool holds_bars() const;

 private:
  struct Errors {
    std::vector<double> rest, posed;  ///< of the stature
  };
  /// What a confidence was worth: the error of the landmark that had it, in units of its bar.
  struct Claim {
    double confidence, error_of_bar;
  };
  void claim(const Case& c, const Score& s, const bodice::anatomy::Anatomy& a);
  /// What the warnings of one body say against what was missed on it.
  void weigh_warnings(const Case& c, const Score& s, const bodice::anatomy::Anatomy& a, bool missed);
  void print_claims() const;
  void print_warnings() const;
  void print_kinds() const;
  double false_alarms() const;  ///< of the bodies
  bool every_row_, every_landmark_;
  std::vector<double> agreement_;
  double worst_swap_ = 0.0;
  std::vector<double> height_;            ///< how far each is off, as a fraction of the true one
  std::map<std::string, Errors> errors_;  ///< by landmark, left and right together
  std::vector<Claim> claims_;
  std::map<std::string, std::map<std::string, int>> misses_;  ///< by kind of body, by landmark
  std::map<std::string, std::vector<double>> kinds_;  ///< agreement of each body, negative where unknown
  /// Bodies that were warned of, and those of them that do miss a bar.
  struct Warned {
    int bodies = 0, rightly = 0;
    int wrongly() const { return bodies - rightly; }
  };
  std::map<std::string, Warned> warned_;  ///< by code of the warning
  Warned doubted_;                        ///< by any warning that doubts a landmark
  int bodies_ = 0, refused_ = 0, refused_wrongly_ = 0, missed_ = 0, missed_silently_ = 0;
};

}  // namespace bench
