#include <bodice/engine/json.hpp>

#include <algorithm>

namespace bodice::inline v0_1::engine {
namespace {

/// Where the member is or belongs.
template <bool kSorted, class Object>
auto seek(Object& members, std::string_view key) {
  if constexpr (kSorted)
    return std::ranges::lower_bound(members, key, {}, [](const auto& m) { return std::string_view(m.key); });
  else
    return std::ranges::find(members, key, [](const auto& m) { return std::string_view(m.key); });
}

}  // namespace

template <bool kSorted>
BasicJson<kSorted>::BasicJson(Kind kind) : kind_(kind) {
  if (kind == Kind::kArray) data_.array = new Array();
  if (kind == Kind::kObject) data_.object = new Object();
}

template <bool kSorted>
BasicJson<kSorted>::BasicJson(const BasicJson& other) : data_(other.data_) {
  if (other.is_string()) data_.text = new std::string(*other.data_.text);
  if (other.is_array()) data_.array = new Array(*other.data_.array);
  if (other.is_object()) data_.object = new Object(*other.data_.object);
  kind_ = other.kind_;
}

template <bool kSorted>
BasicJson<kSorted>::BasicJson(BasicJson&& other) noexcept
    : kind_(std::exchange(other.kind_, Kind::kNull)), data_(other.data_) {}

template <bool kSorted>
BasicJson<kSorted>& BasicJson<kSorted>::operator=(BasicJson other) noexcept {
  std::swap(kind_, other.kind_), std::swap(data_, other.data_);
  return *this;
}

/// Values of any depth are taken apart without recursion.
template <bool kSorted>
BasicJson<kSorted>::~BasicJson() {
  if (is_string()) delete data_.text;
  if (!is_array() && !is_object()) return;
  Array waiting;
  const auto take = [&](BasicJson& value) {
    if (value.is_array() || value.is_object()) waiting.push_back(std::move(value));
  };
  const auto release = [&](BasicJson& value) {
    if (value.is_array()) {
      for (BasicJson& element : *value.data_.array) take(element);
      delete value.data_.array;
    } else {
      for (Member& member : *value.data_.object) take(member.value);
      delete value.data_.object;
    }
    value.kind_ = Kind::kNull;
  };
  release(*this);
  while (!waiting.empty()) {
    BasicJson value = std::move(waiting.back());
    waiting.pop_back();
    release(value);
  }
}

template <bool kSorted>
BasicJson<kSorted>::BasicJson(std::initializer_list<Item> items) {
  const bool all_pairs = std::ranges::all_of(items, [](const Item& item) {
    return item.value_.is_array() && item.value_.size() == 2 && item.value_[0].is_string();
  });
  if (!all_pairs) {
    *this = array(items);
    return;
  }
  *this = object();
  for (const Item& item : items)
    if (const std::string& key = *item.value_[0].data_.text; !contains(key))
      (*this)[key] = std::move(item.value_[1]);
}

template <bool kSorted>
BasicJson<kSorted>::BasicJson(const char* text) : BasicJson(std::string(text)) {}
template <bool kSorted>
BasicJson<kSorted>::BasicJson(std::string_view text) : BasicJson(std::string(text)) {}
template <bool kSorted>
BasicJson<kSorted>::BasicJson(std::string text) : kind_(Kind::kText) {
  data_.text = new std::string(std::move(text));
}

template <bool kSorted>
BasicJson<kSorted>::BasicJson(const BasicJson<!kSorted>& other) {
  using Other = typename BasicJson<!kSorted>::Kind;
  if (other.kind_ == Other::kArray) {
    *this = array();
    for (const auto& element : other) push_back(BasicJson(element));
  } else if (other.kind_ == Other::kObject) {
    *this = object();
    for (const auto& [key, value] : other.items()) (*this)[key] = BasicJson(value);
  } else if (other.kind_ == Other::kText) {
    *this = BasicJson(other.text());
  } else {
    kind_ = static_cast<Kind>(other.kind_);
    data_.natural = other.data_.natural;
  }
}

template <bool kSorted>
BasicJson<kSorted> BasicJson<kSorted>::array(std::initializer_list<Item> items) {
  BasicJson list = array();
  list.data_.array->reserve(items.size());
  for (const Item& item : items) list.data_.array->push_back(std::move(item.value_));
  return list;
}

template <bool kSorted>
void BasicJson<kSorted>::refuse(const char* wanted) const {
  throw JsonError(JsonError::Kind::kType, std::string("A JSON value is not ") + wanted + ".");
}

template <bool kSorted>
const std::string& BasicJson<kSorted>::text() const {
  if (!is_string()) refuse("text");
  return *data_.text;
}

template <bool kSorted>
bool BasicJson<kSorted>::boolean() const {
  if (!is_boolean()) refuse("true or false");
  return data_.boolean;
}

template <bool kSorted>
double BasicJson<kSorted>::number() const {
  if (kind_ == Kind::kInteger) return static_cast<double>(data_.integer);
  if (kind_ == Kind::kUnsigned) return static_cast<double>(data_.natural);
  if (kind_ != Kind::kFloat) refuse("a number");
  return data_.real;
}

template <bool kSorted>
std::uint64_t BasicJson<kSorted>::whole_number() const {
  if (kind_ == Kind::kFloat) return static_cast<std::uint64_t>(static_cast<std::int64_t>(data_.real));
  if (!is_number_integer()) refuse("a number");
  return kind_ == Kind::kUnsigned ? data_.natural : static_cast<std::uint64_t>(data_.integer);
}

template <bool kSorted>
const typename BasicJson<kSorted>::Array& BasicJson<kSorted>::elements() const {
  if (!is_array()) refuse("an array");
  return *data_.array;
}

template <bool kSorted>
std::size_t BasicJson<kSorted>::size() const {
  if (is_array()) return data_.array->size();
  if (is_object()) return data_.object->size();
  return is_null() ? 0 : 1;
}

template <bool kSorted>
void BasicJson<kSorted>::push_back(BasicJson value) {
  if (is_null()) *this = array();
  if (!is_array()) refuse("an array");
  data_.array->push_back(std::move(value));
}

template <bool kSorted>
const typename BasicJson<kSorted>::Object& BasicJson<kSorted>::items() const {
  static const Object kNone;
  return is_object() ? *data_.object : kNone;
}

template <bool kSorted>
const BasicJson<kSorted>* BasicJson<kSorted>::find(std::string_view key) const {
  const Object& members = items();
  const auto found = seek<kSorted>(members, key);
  return found != members.end() && found->key == key ? &found->value : nullptr;
}

template <bool kSorted>
BasicJson<kSorted>* BasicJson<kSorted>::find(std::string_view key) {
  return const_cast<BasicJson*>(std::as_const(*this).find(key));
}

template <bool kSorted>
const BasicJson<kSorted>& BasicJson<kSorted>::operator[](std::string_view key) const {
  static const BasicJson kNothing;
  const BasicJson* found = find(key);
  return found ? *found : kNothing;
}

template <bool kSorted>
BasicJson<kSorted>& BasicJson<kSorted>::operator[](std::string_view key) {
  if (is_null()) *this = object();
  if (!is_object()) refuse("an object");
  const auto found = seek<kSorted>(*data_.object, key);
  if (found != data_.object->end() && found->key == key) return found->value;
  return data_.object->insert(found, Member{std::string(key), {}})->value;
}

template <bool kSorted>
const BasicJson<kSorted>& BasicJson<kSorted>::at(std::string_view key) const {
  const BasicJson* found = find(key);
  if (!found) refuse(("an object with a member " + std::string(key)).c_str());
  return *found;
}

template <bool kSorted>
void BasicJson<kSorted>::erase(std::string_view key) {
  erase_if([&](const Member& member) { return member.key == key; });
}

template <bool kSorted>
void BasicJson<kSorted>::update(const BasicJson& other) {
  for (const Member& member : other.items()) (*this)[member.key] = member.value;
}

template <bool kSorted>
bool BasicJson<kSorted>::operator==(const BasicJson& other) const {
  if (is_number_integer() && other.is_number_integer())
    return is_number_unsigned() == other.is_number_unsigned() && data_.natural == other.data_.natural;
  if (is_number() && other.is_number()) return number() == other.number();
  if (kind_ != other.kind_) return false;
  switch (kind_) {
    case Kind::kBoolean:
      return data_.boolean == other.data_.boolean;
    case Kind::kText:
      return *data_.text == *other.data_.text;
    case Kind::kArray:
      return *data_.array == *other.data_.array;
    case Kind::kObject:
      return std::ranges::equal(*data_.object, *other.data_.object, [](const Member& a, const Member& b) {
        return a.key == b.key && a.value == b.value;
      });
    default:
      return true;
  }
}

template class BasicJson<false>;
template class BasicJson<true>;

}  // namespace bodice::engine
