#include "arrays/strided.hpp"

#include <cstdint>
#include <limits>

#include "base/handles.hpp"

namespace bodice::inline v0_1::capi {
namespace {

Outcome check_scalar(std::int32_t scalar, const char* name) {
  if (scalar == BODICE_FLOAT || scalar == BODICE_DOUBLE) return {};
  return invalid(std::string(name) + " has numbers of type " + std::to_string(scalar) + ".",
                 "Give BODICE_FLOAT or BODICE_DOUBLE.");
}

std::size_t bytes_of(bool is_double) {
  return is_double ? sizeof(double) : sizeof(float);
}

}  // namespace

bool StridedVectors::is_packed_floats() const {
  const auto aligned = [](const Strided& numbers) {
    return numbers.stride == sizeof(float) &&
           reinterpret_cast<std::uintptr_t>(numbers.data) % alignof(float) == 0;
  };
  return !is_double && aligned(x) && aligned(y) && aligned(z);
}

void StridedVectors::get(std::size_t i, double (&out)[3]) const {
  const Strided* from[] = {&x, &y, &z};
  for (int axis = 0; axis < 3; ++axis)
    out[axis] = is_double ? from[axis]->get<double>(i) : double{from[axis]->get<float>(i)};
}

void StridedVectors::set(std::size_t i, const double (&value)[3]) const {
  const Strided* to[] = {&x, &y, &z};
  for (int axis = 0; axis < 3; ++axis) {
    if (is_double)
      to[axis]->set(i, value[axis]);
    else
      to[axis]->set(i, static_cast<float>(value[axis]));
  }
}

Outcome read_elements(void* data, std::ptrdiff_t stride, std::size_t element_bytes, std::size_t elements,
                      const char* name, Strided& out) {
  out = {};
  if (!data) return {};
  const auto bytes = static_cast<std::ptrdiff_t>(element_bytes);
  if (stride == 0) stride = bytes;
  if (stride > -bytes && stride < bytes)
    return invalid(std::string(name) + " has a stride of " + std::to_string(stride) +
                       " bytes for elements of " + std::to_string(bytes) + ".",
                   "Give the bytes from one element to the next, or 0 if nothing lies between them.");
  constexpr std::ptrdiff_t kMost = std::numeric_limits<std::ptrdiff_t>::max();
  const std::ptrdiff_t length = stride < 0 ? (stride == -kMost - 1 ? kMost : -stride) : stride;
  if (elements > 0 && static_cast<std::size_t>(kMost / length) < elements)
    return invalid(std::string(name) + " would reach beyond the address space with " +
                       std::to_string(elements) + " elements of " + std::to_string(stride) + " bytes.",
                   "Check count and stride.");
  out = {static_cast<char*>(data), stride};
  return {};
}

Outcome read_vectors(const bodice_vectors& given, std::size_t elements, const char* name,
                     StridedVectors& out) {
  out = {};
  if (!given.x && !given.y && !given.z) return {};
  const bool together = !given.y && !given.z;
  if (!given.x || (!together && (!given.y || !given.z)))
    return invalid(std::string(name) + " lacks one of x, y and z.",
                   "Give all three, or x alone where the numbers of a vector follow one another.");
  BODICE_CHECK(check_scalar(given.scalar, name));
  out.is_double = given.scalar == BODICE_DOUBLE;
  const std::size_t number = bytes_of(out.is_double);
  Strided first;
  BODICE_CHECK(read_elements(given.x, given.stride, together ? 3 * number : number, elements, name, first));
  out.x = first;
  if (together) {
    out.y = {first.data + number, first.stride};
    out.z = {first.data + 2 * number, first.stride};
  } else {
    out.y = {static_cast<char*>(given.y), first.stride};
    out.z = {static_cast<char*>(given.z), first.stride};
  }
  return {};
}

Outcome read_scalars(const bodice_scalars& given, std::size_t elements, const char* name, Strided& out,
                     bool& is_double) {
  out = {};
  if (!given.data) return {};
  BODICE_CHECK(check_scalar(given.scalar, name));
  is_double = given.scalar == BODICE_DOUBLE;
  return read_elements(given.data, given.stride, bytes_of(is_double), elements, name, out);
}

}  // namespace bodice::capi
