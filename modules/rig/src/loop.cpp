#include <bodice/rig/loop.hpp>

#include <algorithm>
#include <cmath>

#include <bodice/rig/lead.hpp>

#include "key_values.hpp"

namespace bodice::inline v0_1::rig {

namespace {

constexpr double kKeysPerSecond = 60.0;  // straight lines between keys this dense look smooth
constexpr int kFewestKeys = 4;

template <class T>
void append(Keys<T>& keys, double time_s, const T& value) {
  keys.time_s.push_back(time_s);
  keys.value.push_back(value);
}

/// The same motion by step or linear keys, the first one at 0 and the last one at `end_s`. Cubic keys become
/// dense linear ones.
template <class T>
Keys<T> lines(const Keys<T>& keys, double end_s) {
  Keys<T> lines;
  if (keys.empty()) return lines;
  const bool cubic = keys.interpolation == Interpolation::kCubic;
  if (!cubic) lines.interpolation = keys.interpolation;
  const auto fill_to = [&](double to_s) {
    const double from_s = lines.time_s.back();
    const int pieces = cubic ? std::max(1, static_cast<int>(std::ceil((to_s - from_s) * kKeysPerSecond))) : 1;
    for (int piece = 1; piece < pieces; ++piece) {
      const double time_s = from_s + (to_s - from_s) * piece / pieces;
      append(lines, time_s, T(value_at(keys, time_s)));
    }
  };
  append(lines, 0.0, T(value_at(keys, 0.0)));
  for (std::size_t k = 0; k < keys.time_s.size(); ++k) {
    if (!(keys.time_s[k] > 0.0 && keys.time_s[k] < end_s)) continue;
    fill_to(keys.time_s[k]);
    append(lines, keys.time_s[k], key_value(keys, k));
  }
  fill_to(end_s);
  append(lines, end_s, T(value_at(keys, end_s)));
  return lines;
}

enum class Ends { kMove, kRest };

/// The keys, and a seam that leads from their end to their start. Where the ends move, it continues the end
/// and reaches the start by the keys' own motion, mirrored in time.
template <class T>
Keys<T> closed(const Keys<T>& keys, double end_s, double seam_s, Ends ends) {
  Keys<T> closed = lines(keys, end_s);
  if (keys.empty() || keys.interpolation == Interpolation::kStep) return closed;
  const auto value = [&](double time_s) -> T { return value_at(keys, std::clamp(time_s, 0.0, end_s)); };
  const int pieces = std::max(kFewestKeys, static_cast<int>(std::ceil(seam_s * kKeysPerSecond)));
  for (int piece = 1; piece <= pieces; ++piece) {
    const double after_s = seam_s * piece / pieces;
    T end = value(end_s), start = value(0.0);
    if (ends == Ends::kMove) {
      end = mirrored(end, value(end_s - lead_s(after_s)));
      start = mirrored(start, value(lead_s(seam_s - after_s)));
    }
    append(closed, end_s + after_s, T(between(end, start, smooth_step(after_s / seam_s))));
  }
  return closed;
}

template <class T>
Keys<T> repeated(const Keys<T>& keys, double period_s, double duration_s) {
  if (keys.empty()) return keys;
  const Keys<T> once = lines(keys, period_s);
  Keys<T> all{once.interpolation, {}, {}};
  for (std::size_t lap = 0; static_cast<double>(lap) * period_s < duration_s; ++lap)
    for (std::size_t k = 0; k < once.time_s.size(); ++k)
      append(all, static_cast<double>(lap) * period_s + once.time_s[k], once.value[k]);
  return lines(all, duration_s);
}

}  // namespace

Clip close_loop(const Clip& clip, double seam_s) {
  Clip loop = clip;
  if (!(seam_s > 0.0) || !(clip.duration_s > 0.0)) return loop;
  for (Track& track : loop.tracks) {
    track.translation = closed(track.translation, clip.duration_s, seam_s, Ends::kMove);
    track.rotation = closed(track.rotation, clip.duration_s, seam_s, Ends::kMove);
    track.scale = closed(track.scale, clip.duration_s, seam_s, Ends::kRest);  // a scale may not become zero
  }
  loop.duration_s += seam_s;
  return loop;
}

Clip repeat(const Clip& clip, double duration_s) {
  Clip all = clip;
  if (!(clip.duration_s > 0.0) || !(duration_s > clip.duration_s)) return all;
  for (Track& track : all.tracks) {
    track.translation = repeated(track.translation, clip.duration_s, duration_s);
    track.rotation = repeated(track.rotation, clip.duration_s, duration_s);
    track.scale = repeated(track.scale, clip.duration_s, duration_s);
  }
  all.duration_s = duration_s;
  return all;
}

}  // namespace bodice::rig
