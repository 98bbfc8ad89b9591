// What bodice uses of C++20's library and libc++ 13, that of Debian's emscripten, does not have. Included
// ahead of every file of a build for the web; newer libraries have all of it.
#include <algorithm>
#include <array>
#include <charconv>
#include <compare>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <memory>
#include <numeric>
#include <string>
#include <utility>

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 14000
_LIBCPP_BEGIN_NAMESPACE_STD

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}

template <class T>
unique_ptr<T> make_unique_for_overwrite(size_t count) {
  return unique_ptr<T>(new remove_extent_t<T>[count]);
}

inline to_chars_result to_chars(char* first, char* last, double value, chars_format, int digits) {
  const int length = snprintf(first, static_cast<size_t>(last - first), "%.*g", digits, value);
  if (length >= last - first) return {last, errc::value_too_large};
  return {first + length, errc()};
}

inline from_chars_result from_chars(const char* first, const char* last, double& value) {
  const string text(first, last);
  char* end = nullptr;
  const double read = strtod(text.c_str(), &end);
  if (end == text.c_str()) return {first, errc::invalid_argument};
  value = read;
  return {first + (end - text.c_str()), errc()};
}

template <class T, size_t kSize>
constexpr auto operator<=>(const array<T, kSize>& a, const array<T, kSize>& b) -> decltype(a[0] <=> b[0]) {
  for (size_t i = 0; i < kSize; ++i)
    if (const auto order = a[i] <=> b[i]; order != 0) return order;
  return decltype(a[0] <=> b[0])::equivalent;
}
template <class A, class B>
constexpr auto operator<=>(const pair<A, B>& a, const pair<A, B>& b)
    -> common_comparison_category_t<decltype(a.first <=> b.first), decltype(a.second <=> b.second)> {
  if (const auto order = a.first <=> b.first; order != 0) return order;
  return a.second <=> b.second;
}

namespace ranges {

template <class Projection, class Predicate>
auto projected_by(Projection& projection, Predicate& predicate) {
  return [&](auto&&... values) -> bool { return invoke(predicate, invoke(projection, values)...); };
}
template <class Range, class Projection = std::identity, class Predicate>
constexpr bool all_of(Range&& range, Predicate predicate, Projection projection = {}) {
  return std::all_of(std::begin(range), std::end(range), projected_by(projection, predicate));
}
template <class Range, class Projection = std::identity, class Predicate>
constexpr bool any_of(Range&& range, Predicate predicate, Projection projection = {}) {
  return std::any_of(std::begin(range), std::end(range), projected_by(projection, predicate));
}
template <class Range, class Projection = std::identity, class Predicate>
constexpr bool none_of(Range&& range, Predicate predicate, Projection projection = {}) {
  return std::none_of(std::begin(range), std::end(range), projected_by(projection, predicate));
}
template <class Range, class Projection = std::identity, class Predicate>
constexpr auto count_if(Range&& range, Predicate predicate, Projection projection = {}) {
  return std::count_if(std::begin(range), std::end(range), projected_by(projection, predicate));
}
template <class Range, class Projection = std::identity, class Predicate>
constexpr auto find_if(Range&& range, Predicate predicate, Projection projection = {}) {
  return std::find_if(std::begin(range), std::end(range), projected_by(projection, predicate));
}
template <class Range, class T, class Projection = std::identity>
constexpr auto find(Range&& range, const T& value, Projection projection = {}) {
  return std::find_if(std::begin(range), std::end(range),
                      [&](auto&& element) { return invoke(projection, element) == value; });
}
template <class Range, class T>
constexpr auto count(Range&& range, const T& value) {
  return std::count(std::begin(range), std::end(range), value);
}
template <class Range, class T>
constexpr auto fill(Range&& range, const T& value) {
  std::fill(std::begin(range), std::end(range), value);
  return std::end(range);
}
template <class Iterator>
struct in_out_of_copy {
  Iterator out;
};
template <class Range, class Iterator>
constexpr auto copy(Range&& range, Iterator to) {
  return in_out_of_copy<Iterator>{std::copy(std::begin(range), std::end(range), to)};
}
template <class A, class B, class Same = equal_to, class OfA = std::identity, class OfB = std::identity>
constexpr bool equal(A&& a, B&& b, Same same = {}, OfA of_a = {}, OfB of_b = {}) {
  return std::equal(std::begin(a), std::end(a), std::begin(b), std::end(b),
                    [&](auto&& x, auto&& y) { return invoke(same, invoke(of_a, x), invoke(of_b, y)); });
}
template <class Range, class Compare = less, class Projection = std::identity>
constexpr void sort(Range&& range, Compare compare = {}, Projection projection = {}) {
  std::sort(std::begin(range), std::end(range), projected_by(projection, compare));
}
template <class Range, class Compare = less, class Projection = std::identity>
constexpr void stable_sort(Range&& range, Compare compare = {}, Projection projection = {}) {
  std::stable_sort(std::begin(range), std::end(range), projected_by(projection, compare));
}
template <class Range, class Iterator, class Compare = less, class Projection = std::identity>
constexpr void nth_element(Range&& range, Iterator nth, Compare compare = {}, Projection projection = {}) {
  std::nth_element(std::begin(range), nth, std::end(range), projected_by(projection, compare));
}
template <class Range, class Compare = less, class Projection = std::identity>
constexpr auto min_element(Range&& range, Compare compare = {}, Projection projection = {}) {
  return std::min_element(std::begin(range), std::end(range), projected_by(projection, compare));
}
template <class Range, class Compare = less, class Projection = std::identity>
constexpr auto max_element(Range&& range, Compare compare = {}, Projection projection = {}) {
  return std::max_element(std::begin(range), std::end(range), projected_by(projection, compare));
}
template <class Range>
constexpr auto min(Range&& range) {
  return *std::min_element(std::begin(range), std::end(range));
}
template <class Range>
constexpr auto max(Range&& range) {
  return *std::max_element(std::begin(range), std::end(range));
}
template <class Range, class T, class Compare = less, class Projection = std::identity>
constexpr auto lower_bound(Range&& range, const T& value, Compare compare = {}, Projection projection = {}) {
  return std::lower_bound(std::begin(range), std::end(range), value, [&](auto&& element, const T& bound) {
    return invoke(compare, invoke(projection, element), bound);
  });
}
template <class Iterator>
struct removed {
  Iterator first, last;
  constexpr Iterator begin() const { return first; }
  constexpr Iterator end() const { return last; }
};
template <class Range, class Compare = equal_to, class Projection = std::identity>
constexpr auto unique(Range&& range, Compare compare = {}, Projection projection = {}) {
  using Iterator = decltype(std::begin(range));
  return removed<Iterator>{std::unique(std::begin(range), std::end(range), projected_by(projection, compare)),
                           std::end(range)};
}

}  // namespace ranges

namespace views {

template <class Range>
struct Reversed {
  Range* range;
  auto begin() const { return std::rbegin(*range); }
  auto end() const { return std::rend(*range); }
};
template <class Range>
auto reverse(Range& range) {
  return Reversed<Range>{&range};
}

}  // namespace views

_LIBCPP_END_NAMESPACE_STD
#endif
