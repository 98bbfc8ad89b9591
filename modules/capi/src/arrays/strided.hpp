// Arrays in memory of the host: checked once a call, then read and written without alignment.
#pragma once

#include <cstring>

#include "base/outcome.hpp"

namespace bodice::inline v0_1::capi {

/// Numbers `stride` bytes apart.
struct Strided {
  char* data = nullptr;
  std::ptrdiff_t stride = 0;

  explicit operator bool() const { return data != nullptr; }
  template <class Scalar>
  Scalar get(std::size_t i) const {
    Scalar value;
    std::memcpy(&value, at(i), sizeof value);
    return value;
  }
  template <class Scalar>
  void set(std::size_t i, Scalar value) const {
    std::memcpy(at(i), &value, sizeof value);
  }
  char* at(std::size_t i) const { return data + static_cast<std::ptrdiff_t>(i) * stride; }
};

/// Vectors of three numbers of one type.
struct StridedVectors {
  Strided x, y, z;
  bool is_double = false;

  explicit operator bool() const { return static_cast<bool>(x); }
  /// Whether the three arrays are floats, aligned and one after the other.
  bool is_packed_floats() const;
  /// Component by component, as double.
  void get(std::size_t i, double (&out)[3]) const;
  void set(std::size_t i, const double (&value)[3]) const;
};

/// Checks vectors of the host for `elements` elements; `name` is what sentences call them. Absent ones are
/// fine.
Outcome read_vectors(const bodice_vectors& given, std::size_t elements, const char* name,
                     StridedVectors& out);
/// The same for single numbers.
Outcome read_scalars(const bodice_scalars& given, std::size_t elements, const char* name, Strided& out,
                     bool& is_double);
/// The same for elements of any other size.
Outcome read_elements(void* data, std::ptrdiff_t stride, std::size_t element_bytes, std::size_t elements,
                      const char* name, Strided& out);

}  // namespace bodice::capi
