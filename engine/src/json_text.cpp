// The only file that compiles the library's parser and writer. Files that include the library take seconds
// longer to compile.
#include <nlohmann/json.hpp>

#include <bodice/engine/json.hpp>

namespace bodice::inline v0_1::engine {
namespace {

using Library = nlohmann::ordered_json;

/// Takes the events of the library's parser and builds a value.
template <bool kSorted>
class Reader : public nlohmann::json_sax<Library> {
 public:
  using Value = BasicJson<kSorted>;
  Value root;

  bool null() override { return add(Value()); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(std::int64_t value) override { return add(value); }
  bool number_unsigned(std::uint64_t value) override { return add(value); }
  bool number_float(double value, const std::string&) override { return add(value); }
  bool string(std::string& value) override { return add(std::move(value)); }
  bool binary(Library::binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(Value::object()); }
  bool start_array(std::size_t) override { return open(Value::array()); }
  bool key(std::string& value) override {
    slot_ = &(*open_.back())[value];
    return true;
  }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t byte, const std::string&, const Library::exception& error) override {
    const bool is_syntax = dynamic_cast<const Library::parse_error*>(&error) != nullptr;
    throw JsonError(is_syntax ? JsonError::Kind::kSyntax : JsonError::Kind::kNumberRange, error.what(), byte);
  }

 private:
  Value* put(Value value) {
    if (open_.empty()) return &(root = std::move(value));
    if (open_.back()->is_object()) return &(*slot_ = std::move(value));
    open_.back()->push_back(std::move(value));
    return open_.back()->end() - 1;
  }
  bool add(Value value) {
    put(std::move(value));
    return true;
  }
  bool open(Value value) {
    open_.push_back(put(std::move(value)));
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  std::vector<Value*> open_;
  Value* slot_ = nullptr;
};

template <bool kSorted>
Library for_library(const BasicJson<kSorted>& value) {
  if (value.is_boolean()) return value.template get<bool>();
  if (value.is_number_float()) return value.template get<double>();
  if (value.is_number_unsigned()) return value.template get<std::uint64_t>();
  if (value.is_number_integer()) return value.template get<std::int64_t>();
  if (value.is_string()) return value.template get<std::string>();
  if (value.is_null()) return nullptr;
  Library out = value.is_array() ? Library::array() : Library::object();
  for (const auto& element : value) out.push_back(for_library(element));
  for (const auto& [key, member] : value.items()) out.emplace(key, for_library(member));
  return out;
}

}  // namespace

template <bool kSorted>
BasicJson<kSorted> BasicJson<kSorted>::parse(std::string_view text) {
  Reader<kSorted> reader;
  Library::sax_parse(text, &reader);
  return std::move(reader.root);
}

template <bool kSorted>
BasicJson<kSorted> BasicJson<kSorted>::parse_or_null(std::string_view text) {
  try {
    return parse(text);
  } catch (const JsonError&) {
    return {};
  }
}

template <bool kSorted>
std::string BasicJson<kSorted>::dump(const JsonStyle& style) const {
  using Handler = Library::error_handler_t;
  try {
    return for_library(*this).dump(style.indent, ' ', style.ascii,
                                   style.replaces_invalid ? Handler::replace : Handler::strict);
  } catch (const Library::exception& error) {
    throw JsonError(JsonError::Kind::kType, error.what());
  }
}

template BasicJson<false> BasicJson<false>::parse(std::string_view);
template BasicJson<true> BasicJson<true>::parse(std::string_view);
template BasicJson<false> BasicJson<false>::parse_or_null(std::string_view);
template BasicJson<true> BasicJson<true>::parse_or_null(std::string_view);
template std::string BasicJson<false>::dump(const JsonStyle&) const;
template std::string BasicJson<true>::dump(const JsonStyle&) const;

}  // namespace bodice::engine
