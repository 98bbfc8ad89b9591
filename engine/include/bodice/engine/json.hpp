// JSON values. The library that parses and writes them is compiled once, in json_text.cpp, because its
// templates would cost each file that includes them several seconds.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <ranges>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <bodice/engine/version.hpp>

namespace bodice::inline v0_1::engine {

/// Thrown where a text is not JSON, where a value is not of the kind that is read, and where text to write is
/// not UTF-8.
struct JsonError : std::runtime_error {
  enum class Kind : std::uint8_t { kSyntax, kNumberRange, kType };

  JsonError(Kind kind_, const std::string& text, std::size_t byte_ = 0)
      : std::runtime_error(text), kind(kind_), byte(byte_) {}

  Kind kind;
  std::size_t byte;  ///< bytes that were read before the error in a text was found; 0 for kType
};

/// How values become text.
struct JsonStyle {
  int indent = -1;                ///< spaces a level; -1: all on one line
  bool ascii = false;             ///< escapes all other characters
  bool replaces_invalid = false;  ///< U+FFFD for bytes that are not UTF-8, instead of an error
};

template <bool kSorted>
class BasicJson;

using Json = BasicJson<false>;       ///< an object keeps its members in the order in which they were added
using SortedJson = BasicJson<true>;  ///< an object keeps its members sorted by their keys

/// A JSON value. Braces make an object of pairs that begin with text, and an array of anything else:
///     Json line = {{"name", "skin"}, {"center", {0.0, 1.2, 0.1}}};
template <bool kSorted>
class BasicJson {
 public:
  struct Member;
  class Item;
  using Array = std::vector<BasicJson>;
  using Object = std::vector<Member>;

  BasicJson() = default;
  BasicJson(const BasicJson& other);
  BasicJson(BasicJson&& other) noexcept;
  BasicJson& operator=(BasicJson other) noexcept;
  ~BasicJson();

  BasicJson(std::initializer_list<Item> items);
  BasicJson(const char* text);
  BasicJson(std::nullptr_t) = delete;  ///< null is BasicJson()
  BasicJson(std::string_view text);
  BasicJson(std::string text);
  BasicJson(std::same_as<bool> auto value) : kind_(Kind::kBoolean) { data_.boolean = value; }
  BasicJson(std::floating_point auto value) : kind_(Kind::kFloat) { data_.real = static_cast<double>(value); }
  template <std::integral T>
  requires(!std::same_as<T, bool>) BasicJson(T value)
      : kind_(std::is_signed_v<T> ? Kind::kInteger : Kind::kUnsigned) {
    if constexpr (std::is_signed_v<T>)
      data_.integer = value;
    else
      data_.natural = value;
  }
  /// An array of the elements, or an object of pairs.
  template <std::ranges::input_range R>
  requires(!std::convertible_to<R, std::string_view> && !std::same_as<std::remove_cvref_t<R>, BasicJson> &&
           !std::same_as<std::remove_cvref_t<R>, BasicJson<!kSorted>>) BasicJson(const R& range) {
    if constexpr (requires { range.begin()->first; }) {
      *this = object();
      for (const auto& [key, value] : range) (*this)[key] = value;
    } else {
      *this = array();
      for (const auto& value : range) push_back(value);
    }
  }
  explicit BasicJson(const BasicJson<!kSorted>& other);

  static BasicJson array() { return BasicJson(Kind::kArray); }
  static BasicJson array(std::initializer_list<Item> items);
  static BasicJson object() { return BasicJson(Kind::kObject); }

  /// The value that the text stands for. Of members with the same key the last one counts. Throws JsonError.
  static BasicJson parse(std::string_view text);
  /// The same, but null for a text that is not JSON.
  static BasicJson parse_or_null(std::string_view text);
  std::string dump(const JsonStyle& style = {}) const;

  bool is_null() const { return kind_ == Kind::kNull; }
  bool is_boolean() const { return kind_ == Kind::kBoolean; }
  bool is_number_float() const { return kind_ == Kind::kFloat; }
  bool is_number_unsigned() const {
    return kind_ == Kind::kUnsigned || (kind_ == Kind::kInteger && data_.integer >= 0);
  }
  bool is_number_integer() const { return kind_ == Kind::kUnsigned || kind_ == Kind::kInteger; }
  bool is_number() const { return is_number_integer() || is_number_float(); }
  bool is_string() const { return kind_ == Kind::kText; }
  bool is_array() const { return kind_ == Kind::kArray; }
  bool is_object() const { return kind_ == Kind::kObject; }

  /// A number, a truth value, a text or an array of them as T. Throws JsonError for another kind.
  template <class T>
  T get() const {
    if constexpr (std::same_as<T, BasicJson>)
      return *this;
    else if constexpr (std::same_as<T, std::string>)
      return text();
    else if constexpr (std::same_as<T, bool>)
      return boolean();
    else if constexpr (std::floating_point<T>)
      return static_cast<T>(number());
    else if constexpr (std::integral<T>)
      return static_cast<T>(whole_number());
    else {
      T values;
      for (const BasicJson& value : elements())
        values.push_back(value.template get<typename T::value_type>());
      return values;
    }
  }

  /// The number of elements or of members, 0 for null, 1 for any other value.
  std::size_t size() const;
  bool empty() const { return size() == 0; }

  /// Elements of an array; of any other value there are none.
  const BasicJson* begin() const { return is_array() ? data_.array->data() : nullptr; }
  const BasicJson* end() const { return is_array() ? data_.array->data() + data_.array->size() : nullptr; }
  BasicJson* begin() { return is_array() ? data_.array->data() : nullptr; }
  BasicJson* end() { return is_array() ? data_.array->data() + data_.array->size() : nullptr; }
  /// Precondition: an array with an element i.
  const BasicJson& operator[](std::integral auto i) const { return begin()[i]; }
  BasicJson& operator[](std::integral auto i) { return begin()[i]; }
  /// Null becomes an array. Throws JsonError for another kind than that.
  void push_back(BasicJson value);

  /// Members of an object; of any other value there are none.
  const Object& items() const;
  /// The member's value; nullptr where there is none.
  const BasicJson* find(std::string_view key) const;
  BasicJson* find(std::string_view key);
  bool contains(std::string_view key) const { return find(key) != nullptr; }
  /// The member's value; null where there is none.
  const BasicJson& operator[](std::string_view key) const;
  const BasicJson& operator[](const char* key) const { return (*this)[std::string_view(key)]; }
  /// The member's value, which is added where there is none. Null becomes an object. Throws JsonError for
  /// another kind.
  BasicJson& operator[](std::string_view key);
  BasicJson& operator[](const char* key) { return (*this)[std::string_view(key)]; }
  /// The member's value. Throws JsonError where there is none.
  const BasicJson& at(std::string_view key) const;
  /// The member's value as T, or `otherwise` where there is none.
  template <class T>
  T value(std::string_view key, T otherwise) const {
    const BasicJson* found = find(key);
    return found ? found->template get<T>() : otherwise;
  }
  std::string value(std::string_view key, const char* otherwise) const {
    return value(key, std::string(otherwise));
  }
  void erase(std::string_view key);
  /// Removes the members for which `is_unwanted` is true, which may change their values. Nothing for other
  /// kinds.
  template <class F>
  void erase_if(const F& is_unwanted) {
    if (is_object()) std::erase_if(*data_.object, [&](auto& member) { return is_unwanted(member); });
  }
  /// Sets the members of another object.
  void update(const BasicJson& other);

  /// Numbers are equal where their values are.
  bool operator==(const BasicJson& other) const;

 private:
  friend class BasicJson<!kSorted>;
  enum class Kind : std::uint8_t { kNull, kBoolean, kInteger, kUnsigned, kFloat, kText, kArray, kObject };

  explicit BasicJson(Kind kind);
  [[noreturn]] void refuse(const char* wanted) const;
  const std::string& text() const;
  bool boolean() const;
  double number() const;
  std::uint64_t whole_number() const;  ///< modulo 2^64
  const Array& elements() const;

  Kind kind_ = Kind::kNull;
  union {
    bool boolean;
    std::int64_t integer;
    std::uint64_t natural;
    double real;
    std::string* text;
    Array* array;
    Object* object;
  } data_ = {};
};

/// A key of an object and its value.
template <bool kSorted>
struct BasicJson<kSorted>::Member {
  std::string key;
  BasicJson value;
};

/// An element in braces: it is moved and not copied, unlike elements of other lists in braces.
template <bool kSorted>
class BasicJson<kSorted>::Item {
 public:
  template <class T>
  requires(std::constructible_from<BasicJson, T> && !std::same_as<std::remove_cvref_t<T>, Item>)
      Item(T&& value)
      : value_(std::forward<T>(value)) {}
  Item(std::initializer_list<Item> items) : value_(items) {}

 private:
  friend class BasicJson;
  mutable BasicJson value_;
};

extern template class BasicJson<false>;
extern template class BasicJson<true>;

}  // namespace bodice::engine
