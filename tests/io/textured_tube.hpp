// A garment with two materials and a texture that has a seam, as OBJ with its library of materials.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <bodice/io/import.hpp>
#include <bodice_test/shapes.hpp>

#include "figure.hpp"

namespace io_test {

namespace geometry = bodice::geometry;
using namespace std::string_literals;

/// A red pixel, as libpng writes it.
inline const std::string kPng =
    "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x01\0\0\0\x01\x08\x02\0\0\0\x90wS\xde\0\0\0\x0cIDATx\x9c"
    "c\xf8\xcf\xc0\0\0\x03\x01\x01\0\xc9\xfe\x92\xef\0\0\0\0IEND\xae"
    "B`\x82"s;

/// A corner of a triangle: its position and where it lies in the texture, v upward.
using Corner = std::array<double, 5>;

/// A tube with a texture around it, so that its seam has two texture coordinates a vertex. The upper
/// rows have a material of their own.
struct Tube {
  TriMesh mesh = mapped(bodice_test::cylinder(0.35, 0.6, 24, 6, false),
                        [](const Vec3& p) { return Vec3(p + Vec3(0.0, 0.9, 0.0)); });
  std::vector<Corner> corners;
  std::vector<bool> upper;  // #F

  Tube() {
    for (const geometry::Triangle& triangle : mesh.triangles) {
      double least = 10.0, lowest = 10.0;
      for (const geometry::Index v : triangle) {
        least = std::min(least, around(v));
        lowest = std::min(lowest, mesh.positions[v].y());
      }
      upper.push_back(lowest > 0.95);
      for (const geometry::Index v : triangle) {
        const Vec3& p = mesh.positions[v];
        const double u = around(v) - least > 0.5 ? around(v) - 1.0 : around(v);
        corners.push_back({p.x(), p.y(), p.z(), u, p.y()});
      }
    }
  }
  double around(geometry::Index v) const {
    const Vec3& p = mesh.positions[v];
    return std::round(24.0 * (std::atan2(p.z(), p.x()) / 6.283185307179586 + 0.5)) / 24.0;
  }

  std::string obj() const {
    std::ostringstream out;
    out.precision(12);
    out << "mtllib tube.mtl\no Tube\n";
    for (const Corner& c : corners)
      out << "v " << c[0] << ' ' << c[1] << ' ' << c[2] << "\nvt " << c[3] << ' ' << c[4] << '\n';
    for (const bool above : {false, true}) {
      out << "usemtl " << (above ? "Band" : "Checks") << '\n';
      for (std::size_t t = 0; t < upper.size(); ++t)
        if (upper[t] == above) {
          out << 'f';
          for (std::size_t k = 3 * t + 1; k < 3 * t + 4; ++k) out << ' ' << k << '/' << k;
          out << '\n';
        }
    }
    return out.str();
  }
};

inline constexpr const char* kMtl =
    "newmtl Checks\nKd 0.8 0.8 0.8\nNs 30\nmap_Kd -s 1 1 1 pixel one.png\n\nnewmtl Band\nKd 0.6 0.1 0.2\nd "
    "0.5\n";

inline bodice::io::ImportedMesh imported(const std::filesystem::path& file) {
  auto garment = bodice::io::import_garment(kContext, file, {});
  REQUIRE_MESSAGE(garment.ok(), (garment.ok() ? std::string() : garment.error().sentence()));
  return std::move(garment).value();
}

}  // namespace io_test
