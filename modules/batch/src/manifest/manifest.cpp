#include "manifest/manifest.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "manifest/job_text.hpp"
#include "manifest/sha256.hpp"

namespace bodice::inline v0_1::batch {
namespace {

namespace fs = std::filesystem;
using engine::Error;
using engine::ErrorCode;

constexpr std::size_t kLongestLine = std::size_t{1} << 20;
constexpr std::size_t kChunk = std::size_t{1} << 18;
constexpr std::size_t kMostLines = (std::size_t{1} << 31) - 1;  // bits of a line number

/// Calls use(offset, line) for each line without its end. A line of more than kLongestLine bytes is cut
/// there. Returns false if the file cannot be read.
template <class Use>
bool for_each_line(int descriptor, Use use) {
  std::string text;
  std::uint64_t begin = 0;
  bool skips = false;  // the rest of a line that is too long
  for (std::vector<char> chunk(kChunk);;) {
    const ssize_t count = ::pread(descriptor, chunk.data(), kChunk, static_cast<off_t>(begin + text.size()));
    if (count < 0) return false;
    text.append(chunk.data(), static_cast<std::size_t>(count));
    std::size_t from = 0;
    for (std::size_t end; (end = text.find('\n', from)) != std::string::npos; from = end + 1) {
      if (!skips) use(begin + from, std::string_view(text).substr(from, end - from));
      skips = false;
    }
    const bool is_last = count == 0 && from < text.size();
    const bool too_long = text.size() - from > kLongestLine;
    if ((is_last || too_long) && !skips) use(begin + from, std::string_view(text).substr(from, kLongestLine));
    if (too_long) skips = true, from = text.size();
    begin += from;
    text.erase(0, from);
    if (count == 0) return true;
  }
}

std::string_view trimmed(std::string_view line) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (line.starts_with(kMark)) line.remove_prefix(kMark.size());
  while (!line.empty() && std::strchr(" \t\r", line.back())) line.remove_suffix(1);
  while (!line.empty() && std::strchr(" \t", line.front())) line.remove_prefix(1);
  return line;
}

Error unreadable(const fs::path& file, const std::string& why, std::string remedy) {
  return {ErrorCode::kUnreadable, "The manifest '" + file.string() + "' " + why + ".", std::move(remedy)};
}

}  // namespace

/// A line while the order is found.
struct Manifest::Index {
  std::array<std::uint64_t, 2> share = {};  ///< key that jobs with one shared step have in common
  Entry entry;
  std::uint32_t first = 0;  ///< line of the first job that shares it
  bool is_job = false;      ///< whether the line can be read
};

Manifest::Manifest(fs::path file, int descriptor, const Work& work)
    : file_(std::move(file)), descriptor_(descriptor), work_(&work), is_csv_(file_.extension() == ".csv") {}

Manifest::Manifest(Manifest&& other) noexcept
    : file_(std::move(other.file_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      work_(other.work_),
      columns_(std::move(other.columns_)),
      is_csv_(other.is_csv_),
      lines_(other.lines_),
      entries_(std::move(other.entries_)) {}

Manifest::~Manifest() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

engine::Result<Manifest> Manifest::open(const fs::path& file, const Work& work, const Shard& shard,
                                        const engine::CancelToken& cancel) {
  if (shard.count < 1 || shard.index >= shard.count)
    return Error{
        ErrorCode::kInvalidArgument,
        "There is no shard " + std::to_string(shard.index) + " of " + std::to_string(shard.count) + ".",
        "Give i/n with i from 0 to n - 1."};
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0)
    return Error{ErrorCode::kNotFound,
                 "The manifest '" + file.string() + "' cannot be opened: " + std::strerror(errno) + ".",
                 "Check the path."};
  Manifest manifest(file, descriptor, work);
  struct stat status = {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode))
    return unreadable(file, "is not a file", "Write its lines to a file: they are read more than once.");
  if (auto built = manifest.build(shard, cancel); !built) return std::move(built).error();
  return manifest;
}

engine::Result<Job> Manifest::parse(std::string_view line, std::size_t number) const {
  const auto where = [&] { return file_.string() + ":" + std::to_string(number) + ": "; };
  if (line.size() >= kLongestLine)
    return Error{ErrorCode::kUnreadable, where() + "this line is longer than a megabyte.", "Split it."};
  auto job = is_csv_ ? job_from_csv(line, columns_) : job_from_json(line);
  if (!job) return Error{job.error().code, where() + job.error().message, job.error().remedy};
  job->line = number;
  const fs::path folder = file_.parent_path();
  for (auto& [name, values] : job->values)
    for (std::string& value : values)
      if (work_->is_file(name, value)) value = (folder / value).lexically_normal().string();
  return job;
}

/// What parse() and the work find in a line; `first_error` keeps the error of the first one that is no job.
Manifest::Index Manifest::index_of(std::string_view line, std::size_t number,
                                   std::optional<Error>& first_error) const {
  Index item;
  item.entry.length = static_cast<std::uint32_t>(line.size());
  item.entry.line = static_cast<std::uint32_t>(number) & 0x7fffffffu;
  Sha256 hash;
  const auto job = parse(line, number);
  item.is_job = static_cast<bool>(job);
  // A broken line shares nothing.
  hash.add(job ? "job" + work_->shared(*job) : "line" + std::to_string(number));
  if (!job && !first_error) first_error = job.error();
  const auto bytes = hash.finish();
  std::memcpy(item.share.data(), bytes.data(), sizeof item.share);
  return item;
}

engine::Result<std::vector<Manifest::Index>> Manifest::index_lines(const engine::CancelToken& cancel) {
  std::size_t count = 1;
  bool readable = for_each_line(descriptor_, [&](std::uint64_t, std::string_view) { ++count; });
  if (count > kMostLines) return unreadable(file_, "has more than 2^31 lines", "Split it.");
  std::vector<Index> index;
  index.reserve(count);
  std::size_t number = 0;
  std::optional<Error> broken, first_error;
  const auto read = [&](std::uint64_t offset, std::string_view text) {
    ++number;
    const std::string_view line = trimmed(text);
    if (cancel.canceled() || line.empty()) return;
    if (is_csv_ && columns_.empty()) {
      auto names = csv_fields(line);
      if (!names) broken = names.error();
      columns_ = names ? std::move(names).value() : std::vector<std::string>{""};
      return;
    }
    index.push_back(index_of(line, number, first_error));
    index.back().entry.offset = offset + static_cast<std::uint64_t>(line.data() - text.data());
  };
  readable = readable && for_each_line(descriptor_, read);
  if (!readable) return unreadable(file_, "cannot be read", "Check the disk.");
  if (broken) return unreadable(file_, "has a broken first line", "Name the columns there.");
  if (cancel.canceled()) return Error{ErrorCode::kCanceled, "The batch was canceled.", ""};
  if (first_error && std::ranges::none_of(index, &Index::is_job))
    return Error{ErrorCode::kUnreadable, "There is no job in the manifest. " + first_error->message,
                 first_error->remedy};
  return index;
}

void Manifest::order_by_share(std::vector<Index>& index) {
  std::ranges::sort(index, {},
                    [](const Index& i) { return std::pair(i.share, std::uint32_t{i.entry.line}); });
  for (std::size_t i = 0; i < index.size(); ++i) {
    const bool same = i > 0 && index[i].share == index[i - 1].share;
    index[i].first = same ? index[i - 1].first : std::uint32_t{index[i].entry.line};
  }
  std::ranges::sort(index, {},
                    [](const Index& i) { return std::pair(i.first, std::uint32_t{i.entry.line}); });
}

engine::Result<void> Manifest::build(const Shard& shard, const engine::CancelToken& cancel) {
  auto indexed = index_lines(cancel);
  if (!indexed) return std::move(indexed).error();
  std::vector<Index>& index = *indexed;
  order_by_share(index);
  lines_ = index.size();
  const std::size_t begin = lines_ * shard.index / shard.count,
                    end = lines_ * (shard.index + 1) / shard.count;
  entries_.reserve(end - begin);
  for (std::size_t i = begin; i < end; ++i) {
    entries_.push_back(index[i].entry);
    entries_.back().continues = i > begin && index[i].first == index[i - 1].first ? 1 : 0;
  }
  return {};
}

engine::Result<Job> Manifest::read_line(std::uint64_t offset, const Entry& entry) const {
  std::string line(entry.length, '\0');
  if (::pread(descriptor_, line.data(), line.size(), static_cast<off_t>(offset)) !=
      static_cast<ssize_t>(line.size()))
    return unreadable(file_, "has changed while the batch runs", "Start the batch again.");
  return parse(line, entry.line);
}

std::string Manifest::address(std::size_t i) const {
  const Entry& entry = entries_[i];
  return std::to_string(entry.offset) + " " + std::to_string(entry.length) + " " +
         std::to_string(std::uint32_t{entry.line});
}

engine::Result<Job> Manifest::read_at(const std::string& address) const {
  char* rest = nullptr;
  Entry entry;
  entry.offset = std::strtoull(address.c_str(), &rest, 10);
  entry.length = static_cast<std::uint32_t>(std::strtoul(rest, &rest, 10));
  entry.line = static_cast<std::uint32_t>(std::strtoul(rest, &rest, 10)) & 0x7fffffffu;
  return read_line(entry.offset, entry);
}

}  // namespace bodice::batch
