// Based on: Google. Trace Event Format. (complete events "X", instants "i", metadata "M")
#include <cstdio>

#include <bodice/engine/trace.hpp>
#include <bodice/engine/write_file.hpp>

namespace bodice::inline v0_1::engine {
namespace {

void append_quoted(std::string& out, std::string_view text) {
  out += '"';
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    const bool control = static_cast<unsigned char>(c) < 0x20;
    out += control ? ' ' : c;
  }
  out += '"';
}

void append_us(std::string& out, std::int64_t ns) {
  char text[48];
  std::snprintf(text, sizeof text, "%lld.%03d", static_cast<long long>(ns / 1000),
                static_cast<int>(ns % 1000));
  out += text;
}

std::size_t number_of(std::thread::id thread, std::vector<std::thread::id>& seen) {
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen[i] == thread) return i;
  }
  seen.push_back(thread);
  return seen.size() - 1;
}

void append_event(std::string& out, const TraceEvent& event, std::size_t thread, std::int64_t start_ns) {
  const bool instant = event.begin_ns == event.end_ns;
  out += R"({"ph":")";
  out += instant ? R"(i","s":"t")" : "X\"";
  out += R"(,"pid":1,"tid":)" + std::to_string(thread) + ",\"name\":";
  append_quoted(out, event.name);
  out += ",\"ts\":";
  append_us(out, event.begin_ns - start_ns);
  if (!instant) {
    out += ",\"dur\":";
    append_us(out, event.end_ns - event.begin_ns);
  }
  if (event.value != kNoTraceValue) out += R"(,"args":{"value":)" + std::to_string(event.value) + "}";
  out += "},\n";
}

}  // namespace

std::string Trace::json() const {
  const std::vector<TraceEvent> all = events();
  const std::int64_t start_ns = all.empty() ? 0 : all.front().begin_ns;
  std::vector<std::thread::id> threads;
  std::string out = "{\"traceEvents\":[\n";
  for (const TraceEvent& event : all) append_event(out, event, number_of(event.thread, threads), start_ns);
  for (std::size_t i = 0; i < threads.size(); ++i) {
    out += R"({"ph":"M","pid":1,"name":"thread_name","tid":)" + std::to_string(i) +
           R"(,"args":{"name":"thread )" + std::to_string(i) + "\"}},\n";
  }
  out += R"({"ph":"M","pid":1,"name":"process_name","args":{"name":"bodice"}}],)";
  out += R"("displayTimeUnit":"ms","otherData":{"dropped":)" + std::to_string(dropped()) + "}}\n";
  return out;
}

Result<void> Trace::write(const std::filesystem::path& path) const {
  return write_file(path, json());
}

}  // namespace bodice::engine
