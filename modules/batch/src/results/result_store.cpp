#include "results/result_store.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>

#include <unistd.h>

#include <bodice/engine/write_file.hpp>

namespace bodice::inline v0_1::batch {
namespace {

namespace fs = std::filesystem;
using engine::Error;
using engine::ErrorCode;

constexpr std::size_t kSpareBytes = std::size_t{1} << 20;

Error refused(const fs::path& path, const std::error_code& why) {
  return {ErrorCode::kWriteFailed, "'" + path.string() + "' could not be written: " + why.message() + ".",
          "Check the path, write permission and free space."};
}

/// When a process of this machine started, in ticks since the boot; empty where it has ended. With the number
/// of the process it names one process of a boot, although numbers are used again.
std::string start_of(const std::string& process) {
  std::ifstream file("/proc/" + process + "/stat");
  std::string text;
  std::getline(file, text);
  std::istringstream fields(
      text.substr(std::min(text.rfind(')') + 1, text.size())));  // a name may have spaces
  std::string state, field;
  fields >> state;
  for (int i = 4; i <= 22; ++i) fields >> field;
  return !fields || state == "Z" || state == "X" ? std::string() : field;
}

/// The beginning of all names of this process in OUT/part: machine.process.start.
std::string own_mark() {
  const std::string process = std::to_string(::getpid());
  return host_name() + "." + process + "." + start_of(process) + ".";
}

}  // namespace

std::string host_name() {
  char name[256] = {};
  if (::gethostname(name, sizeof name - 1) != 0 || name[0] == '\0') return "machine";
  std::string text(name);
  for (char& c : text)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '-';
  return text;
}

ResultStore::ResultStore(fs::path out) : out_(std::move(out)) {}

engine::Result<ResultStore> ResultStore::open(const fs::path& out) {
  ResultStore store(out);
  for (const fs::path& folder : {out, out / "log", out / "part"}) {
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (failure) return refused(folder, failure);
    if (::access(folder.c_str(), W_OK) != 0) return refused(folder, {errno, std::generic_category()});
  }
  store.remove_leftovers();
  return store;
}

void ResultStore::remove_leftovers() const {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(out_ / "part", ignored)) {
    std::istringstream name(entry.path().filename().string());
    std::string machine, process, start;
    std::getline(name, machine, '.'), std::getline(name, process, '.'), std::getline(name, start, '.');
    // Folders of another machine stay, because that one may still write them.
    if (machine == host_name() && !start.empty() && start_of(process) != start) discard(entry.path());
  }
}

bool ResultStore::has(const std::string& key) const {
  return ::access((out_ / folder_of(key)).c_str(), F_OK) == 0;
}

engine::Result<fs::path> ResultStore::begin(const std::string& key) const {
  const fs::path part = out_ / "part" / (own_mark() + key);
  std::error_code failure;
  // A folder of this name may remain from an earlier process with the same number.
  fs::remove_all(part, failure);
  if (!failure) fs::create_directory(part, failure);
  if (failure) return refused(part, failure);
  return part;
}

engine::Result<bool> ResultStore::publish(const fs::path& part, const std::string& key) const {
  const fs::path folder = out_ / folder_of(key);
  if (auto flushed = engine::flush_files(part); !flushed) return std::move(flushed).error();
  std::error_code failure;
  fs::create_directory(folder.parent_path(), failure);
  if (!failure) {
    if (::rename(part.c_str(), folder.c_str()) == 0) return true;
    failure = {errno, std::generic_category()};
  }
  discard(part);
  if (has(key)) return false;
  return refused(folder, failure);
}

void ResultStore::discard(const fs::path& part) {
  std::error_code ignored;
  fs::remove_all(part, ignored);
}

engine::Result<void> ResultStore::check_space() const {
  const fs::path probe = out_ / "part" / (own_mark() + "probe");
  const std::string bytes(kSpareBytes, '.');
  auto written = engine::write_file(probe, std::string_view(bytes));
  discard(probe);
  return written;
}

}  // namespace bodice::batch
