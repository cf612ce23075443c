// SPDX-License-Identifier: Apache-2.0
// Reads OBJ and glTF 1.0 through assimp. Node transforms are applied here, in double.
// Vertices are left as assimp reads them, one per corner: welding is one step for all formats (weld.hpp) with its own
// tolerance.
#include "scene/model.hpp"

#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <glm/mat4x4.hpp>
#include <memory>
#include <set>

#include "scene/gltf_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

glm::dmat4 to_double(const aiMatrix4x4& m) {  // assimp is row major, glm column major
  return {m.a1, m.b1, m.c1, m.d1, m.a2, m.b2, m.c2, m.d2, m.a3, m.b3, m.c3, m.d3, m.a4, m.b4, m.c4, m.d4};
}

class ModelReader {
 public:
  ModelReader(const aiScene& scene, std::string file) : scene_(scene) {
    raw_.file = std::move(file);
    for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
      raw_.materials.push_back({scene.mMaterials[i]->GetName().C_Str(), raw_.file, {}, {}, {}, {}});
    }
  }

  RawScene read() {
    node(*scene_.mRootNode, glm::dmat4(1));
    const double float_spacing = largest_ * 0x1p-23;
    if (float_spacing > 1e-3) {
      raw_.warnings.push_back(
          fmt::format("{}: coordinates reach {:.0f}, where float32 keeps only {:.3g}: "
                      "move the model to its origin, or use PLY with double coordinates",
                      raw_.file, largest_, float_spacing));
    }
    return std::move(raw_);
  }

 private:
  void node(const aiNode& n, const glm::dmat4& parent) {
    const glm::dmat4 to_root = parent * to_double(n.mTransformation);
    const glm::dvec3 origin(to_root[3]);
    if (n.mName.length > 0 && std::isfinite(origin.x + origin.y + origin.z))
      raw_.nodes.push_back({n.mName.C_Str(), origin});
    for (unsigned i = 0; i < n.mNumMeshes; ++i) mesh(*scene_.mMeshes[n.mMeshes[i]], n, to_root);
    for (unsigned i = 0; i < n.mNumChildren; ++i) node(*n.mChildren[i], to_root);
  }

  void mesh(const aiMesh& in, const aiNode& n, const glm::dmat4& to_root) {
    if ((in.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0) return;  // points and lines
    RawMesh out;
    out.name = n.mName.length > 0 ? n.mName.C_Str() : in.mName.C_Str();
    out.where = raw_.file;
    const std::string_view material = raw_.materials.at(in.mMaterialIndex).name;
    if (material != AI_DEFAULT_MATERIAL_NAME && !material.empty()) out.material = in.mMaterialIndex;
    out.vertices.reserve(in.mNumVertices);
    double reach_in_mesh = 0;
    for (unsigned i = 0; i < in.mNumVertices; ++i) {
      const aiVector3D& v = in.mVertices[i];
      const glm::dvec3 p(to_root * glm::dvec4(v.x, v.y, v.z, 1));
      for (const float x : {v.x, v.y, v.z}) reach_in_mesh = std::max(reach_in_mesh, std::abs(static_cast<double>(x)));
      const double reach = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
      if (!std::isfinite(p.x + p.y + p.z)) {
        throw InputError(fmt::format("{}: mesh '{}': vertex {} is not finite", raw_.file, out.name, i));
      }
      largest_ = std::max(largest_, reach);
      out.vertices.push_back(p);
    }
    out.rounding = float32_rounding(reach_in_mesh) * largest_stretch(to_root);
    out.triangles.reserve(in.mNumFaces);
    for (unsigned i = 0; i < in.mNumFaces; ++i) {
      const aiFace& f = in.mFaces[i];
      if (f.mNumIndices != 3) continue;
      Triangle t;
      for (unsigned k = 0; k < 3; ++k) {
        t[k] = f.mIndices[k];
        if (t[k] >= in.mNumVertices) {
          throw InputError(
              fmt::format("{}: mesh '{}': face {}: vertex index {} is out of range, the mesh has {} vertices",
                          raw_.file, out.name, i, t[k], in.mNumVertices));
        }
      }
      out.triangles.push_back(t);
    }
    raw_.meshes.push_back(std::move(out));
  }

  const aiScene& scene_;
  RawScene raw_;
  double largest_ = 0;
};

// If the reader of the suffix does not recognise a file, assimp tries its fifty others, so a damaged file would get to
// formats that nobody asked for. Only readers of this suffix are kept.
void keep_readers(Assimp::Importer& importer, const std::string& suffix) {
  for (size_t i = importer.GetImporterCount(); i-- > 0;) {
    Assimp::BaseImporter* const reader = importer.GetImporter(i);
    std::set<std::string> suffixes;
    reader->GetExtensionList(suffixes);
    if (suffixes.contains(suffix)) continue;
    importer.UnregisterLoader(reader);
    delete reader;  // it is ours after it was unregistered
  }
}

// An open file that reports when it is closed: in some places assimp closes it without its IOSystem.
class OpenFile : public Assimp::IOStream {
 public:
  OpenFile(Assimp::IOStream* file, bool& open) : file_(file), open_(open) { open_ = true; }
  ~OpenFile() override { open_ = false; }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  size_t Read(void* buffer, size_t size, size_t count) override { return file_->Read(buffer, size, count); }
  size_t Write(const void* buffer, size_t size, size_t count) override { return file_->Write(buffer, size, count); }
  aiReturn Seek(size_t offset, aiOrigin origin) override { return file_->Seek(offset, origin); }
  size_t Tell() const override { return file_->Tell(); }
  size_t FileSize() const override { return file_->FileSize(); }
  void Flush() override { file_->Flush(); }

 private:
  std::unique_ptr<Assimp::IOStream> file_;
  bool& open_;
};

// Opens an OBJ file, but none of the files that it names. Faces name their materials, so material libraries are not
// needed; and assimp's reader of them writes to address 0 if a material is described before it is named. They are
// requested while the OBJ file itself is open.
class LoneFile : public Assimp::DefaultIOSystem {
 public:
  LoneFile(std::string name, std::string file) : name_(std::move(name)), file_(std::move(file)) {}

  bool Exists(const char* name) const override {
    std::error_code unnameable;
    return name == name_ && std::filesystem::is_regular_file(file_, unnameable);
  }
  Assimp::IOStream* Open(const char* name, const char* mode) override {
    if (!Exists(name) || open_) return nullptr;
    Assimp::IOStream* const file = Assimp::DefaultIOSystem::Open(file_.c_str(), mode);
    return file != nullptr ? new OpenFile(file, open_) : nullptr;
  }
  void Close(Assimp::IOStream* file) override { delete file; }

 private:
  std::string name_, file_;
  bool open_ = false;
};

// Opens plain files only: a glTF names buffers, and a pipe would block. assimp chooses its reader by the suffix, so it
// is given a name with one, and this class maps that name to the real file. It notes which files were opened.
class PlainFiles : public Assimp::DefaultIOSystem {
 public:
  PlainFiles(std::string name, std::string file, std::vector<std::string>& opened)
      : name_(std::move(name)), file_(std::move(file)), opened_(opened) {}

  bool Exists(const char* name) const override {
    std::error_code unnameable;
    return std::filesystem::is_regular_file(file_of(name), unnameable);
  }
  Assimp::IOStream* Open(const char* name, const char* mode) override {
    if (!Exists(name)) return nullptr;
    if (std::find(opened_.begin(), opened_.end(), file_of(name)) == opened_.end()) opened_.push_back(file_of(name));
    return Assimp::DefaultIOSystem::Open(file_of(name), mode);
  }

 private:
  const char* file_of(const char* name) const { return name == name_ ? file_.c_str() : name; }

  std::string name_, file_;
  std::vector<std::string>& opened_;
};

// Tells whether it is a glTF 1 file, which has names where glTF 2 has numbers.
bool is_version_1(const GltfFile& file) {
  const auto asset = file.document.find("asset");
  if (asset == file.document.end() || !asset->is_object()) return false;
  const auto version = asset->find("version");
  return version != asset->end() && version->is_string() && version->get<std::string>().starts_with("1");
}

}  // namespace

ModelFormat model_format(const std::filesystem::path& path) {
  std::string suffix = path.extension().string();
  for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return suffix == ".obj" ? ModelFormat::obj : ModelFormat::gltf;
}

RawScene read_model(const std::filesystem::path& path, ModelFormat format) {
  const bool obj = format == ModelFormat::obj, fits = model_format(path) == format;
  std::vector<std::string> warnings;
  if (obj) {
    warnings = check_obj(path);
  } else {
    const GltfFile file = read_gltf_file(path);
    if (!is_version_1(file)) return read_gltf(file);
    warnings = check_gltf_extensions(file);
  }
  const std::string name = path.string() + (fits ? "" : obj ? ".obj" : ".glb");
  std::vector<std::string> files;
  Assimp::Importer importer;
  if (obj) {  // from here on the importer owns the handlers
    files.push_back(path.string());
    importer.SetIOHandler(new LoneFile(name, path.string()));
  } else {
    importer.SetIOHandler(new PlainFiles(name, path.string(), files));
  }
  keep_readers(importer, obj ? "obj" : "gltf");
  const aiScene* scene = importer.ReadFile(name, aiProcess_Triangulate | aiProcess_SortByPType);
  if (!scene || !scene->mRootNode || (scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE)) {
    throw InputError(fmt::format("{}: cannot be read: {}", path.string(), importer.GetErrorString()));
  }
  RawScene raw = ModelReader(*scene, path.string()).read();
  raw.files = std::move(files);
  raw.warnings.insert(raw.warnings.begin(), warnings.begin(), warnings.end());
  return raw;
}

}  // namespace wavetracer
