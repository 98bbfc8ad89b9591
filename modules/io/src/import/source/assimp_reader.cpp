#include "import/source/assimp_reader.hpp"

#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/importerdesc.h>

namespace bodice::inline v0_1::io {

namespace {

/// assimp's post-processing asserts, and so aborts, on damaged meshes.
constexpr unsigned kNoSteps = 0;

/// Opens one file by another name: assimp looks at extensions even where one reader is left.
class Renamed final : public Assimp::DefaultIOSystem {
 public:
  Renamed(std::string alias, std::string file) : alias_(std::move(alias)), file_(std::move(file)) {}

  bool Exists(const char* name) const override { return DefaultIOSystem::Exists(real(name)); }
  Assimp::IOStream* Open(const char* name, const char* mode) override {
    return DefaultIOSystem::Open(real(name), mode);
  }

 private:
  const char* real(const char* name) const { return alias_ == name ? file_.c_str() : name; }

  std::string alias_, file_;
};

}  // namespace

AssimpReader::AssimpReader(Format format) : format_(format) {
  std::vector<Assimp::BaseImporter*> others;
  for (std::size_t i = 0; i < importer_.GetImporterCount(); ++i)
    if (traits_of(format).reader != importer_.GetImporterInfo(i)->mName)
      others.push_back(importer_.GetImporter(i));
  for (Assimp::BaseImporter* other : others) {
    importer_.UnregisterLoader(other);  // it is the caller's from here on
    delete other;
  }
}

const aiScene* AssimpReader::read(const std::filesystem::path& file) {
  const std::string extension = "." + std::string(traits_of(format_).extension);
  const std::string name = file.string(), alias = name + extension;
  if (file.extension() == extension) return importer_.ReadFile(name, kNoSteps);
  importer_.SetIOHandler(new Renamed(alias, name));  // the importer deletes it
  return importer_.ReadFile(alias, kNoSteps);
}

const aiScene* AssimpReader::read_text(const std::string& text) {
  return importer_.ReadFileFromMemory(text.data(), text.size(), kNoSteps,
                                      std::string(traits_of(format_).extension).c_str());
}

}  // namespace bodice::io
