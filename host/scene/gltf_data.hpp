// SPDX-License-Identifier: Apache-2.0
// The numbers of a glTF 2.0 file: buffers, buffer views and accessors (section 3.6), including sparse and normalised
// ones. The file is not trusted: every access is bounds checked, and no count takes more memory than the file has
// bytes.
#pragma once
#include <map>
#include <string_view>
#include <vector>

#include "scene/gltf_file.hpp"

namespace wavetracer {

class GltfData {
 public:
  // Keeps a reference to the file.
  explicit GltfData(const GltfFile& file);

  // Returns an object of one of the lists of the document. Throws InputError if the index is not a number or is out of
  // range.
  const nlohmann::json& item(const char* list, const nlohmann::json& index) const;
  // Returns the components of all elements, one after the other; normalised integers become 0 to 1 or -1 to 1. Throws
  // if the elements have another number of components.
  std::vector<double> numbers(const nlohmann::json& accessor, size_t components);
  // Returns the bytes of a buffer view.
  std::string_view view(const nlohmann::json& index);
  // Returns the names of the buffers that are separate files.
  const std::vector<std::string>& files() const { return files_; }

  [[noreturn]] void fail(const std::string& what) const;

 private:
  struct Elements;  // says where an accessor's numbers are

  const std::string& buffer(const nlohmann::json& index);
  std::string read_buffer(const nlohmann::json& buffer, size_t index);
  std::string read_uri(const std::string& uri);
  Elements elements(const nlohmann::json& at, uint64_t count, size_t components, int64_t type);
  void put_sparse(const nlohmann::json& accessor, size_t components, std::vector<double>& out);

  const GltfFile& file_;
  std::map<size_t, std::string> buffers_;
  std::vector<std::string> files_;
};

}  // namespace wavetracer
