#pragma once

#include <clocale>
#include <string>

namespace bodice_test {

/// Makes the C library write and read 0,5 for 0.5 during its lifetime, as in a host that called setlocale().
/// active() is false if no such locale is installed.
class CommaLocale {
 public:
  CommaLocale() : before_(std::setlocale(LC_ALL, nullptr)) {
    for (const char* name : {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", "fr_FR", "nl_NL.UTF-8", "ru_RU.UTF-8"}) {
      if (!std::setlocale(LC_ALL, name)) continue;
      active_ = *std::localeconv()->decimal_point == ',';
      if (active_) return;
    }
  }
  ~CommaLocale() { std::setlocale(LC_ALL, before_.c_str()); }
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;

  bool active() const { return active_; }

 private:
  std::string before_;
  bool active_ = false;
};

}  // namespace bodice_test
