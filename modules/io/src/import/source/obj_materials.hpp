// The files that an OBJ refers to: libraries of materials, and their images.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bodice::inline v0_1::io {

/// The files that the lines `mtllib` of an OBJ name, whether they are there or not.
std::vector<std::filesystem::path> material_libraries(const std::filesystem::path& obj);

/// The images that a library of materials names, as it names them.
std::vector<std::string> images_of_library(const std::filesystem::path& library);

}  // namespace bodice::io
