// The container of binary glTF: a JSON document, and a buffer that its accessors refer to.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <bodice/engine/json.hpp>
#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::io {

using engine::Json;
using Vec3f = Eigen::Vector3f;

class GlbBuilder {
 public:
  GlbBuilder();

  /// The functions add_*() append data to the buffer and return the index of its accessor.
  std::size_t add_positions(std::span<const Vec3f> values);  ///< with the bounds that glTF requires
  std::size_t add_vectors(std::span<const Vec3f> values);    ///< normals, colors
  std::size_t add_triangles(std::span<const geometry::Triangle> triangles);
  std::size_t add_times(std::span<const float> seconds);
  std::size_t add_scalars(std::span<const float> values);
  std::size_t add_joints(std::span<const std::uint16_t> values);  ///< of vertices, four each
  std::size_t add_weights(std::span<const float> values);         ///< of vertices, four each
  std::size_t add_values(std::span<const float> values,
                         const char* type);  ///< keys, matrices: "VEC3", "MAT4", ...
  std::size_t add_attribute(std::span<const float> values,
                            const char* type);  ///< what each vertex has: "SCALAR", "VEC2", ...
  /// Adds `count` numbers, ones at rising positions and zeros elsewhere, of which only the ones take space.
  std::size_t add_ones(std::span<const std::uint32_t> at, std::size_t count);
  /// Adds the bytes of an image file; returns the index of its view.
  std::size_t add_image_bytes(std::string_view bytes);

  /// Appends to one of the document's arrays ("nodes", "meshes", ...) and returns the new index.
  std::size_t add(const char* array, Json value);
  /// The number of elements of one of the document's arrays.
  std::size_t size(const char* array) const;
  /// Makes a node a root of the scene.
  void add_to_scene(std::size_t node);
  /// Names an extension that a reader must support.
  void require(std::string_view extension);
  /// Names an extension that a reader may ignore.
  void use(std::string_view extension);

  /// The whole file, or nothing if it exceeds the 4 GiB that the format allows.
  std::string finish() const;

 private:
  friend class GlbSparseWriter;
  std::size_t add_view(const void* data, std::size_t bytes, int target);
  void name_in(const char* list, std::string_view extension);
  std::size_t add_accessor(std::size_t view, int component, std::size_t count, const char* type);

  Json document_;
  std::string buffer_;
};

/// Adds accessors of small integers that list only the elements other than zero. Elements of sparse accessors
/// are packed, where those of others begin at multiples of four bytes: three of 16 bits take 6 bytes, not 8.
class GlbSparseWriter {
 public:
  GlbSparseWriter(std::size_t elements, GlbBuilder& glb) : elements_(elements), glb_(glb) {}

  /// Adds vectors in which the largest integer stands for 1; returns the accessor.
  std::size_t add(std::span<const std::array<std::int16_t, 3>> values);
  std::size_t add(std::span<const std::array<std::int8_t, 3>> values);

 private:
  template <class T>
  std::size_t add_values(std::span<const std::array<T, 3>> values, int component);
  Json indices_of(std::span<const std::uint32_t> listed);

  std::size_t elements_;
  GlbBuilder& glb_;
  Json of_all_;  ///< the indices of all elements, which accessors share
};

}  // namespace bodice::io
