// SPDX-License-Identifier: Apache-2.0
// Maps name spatial references, and PROJ compares a name that it does not know with all names in its database, which
// takes two thirds of the time of the target. These functions stand before those of PROJ and keep its answers: the
// names (URNs) that it refuses, and the list of authorities, which GDAL asks for at every unknown name.
#include <dlfcn.h>
#include <cstdlib>
#include <cstring>
#include <string>
#include <unordered_set>
#include <vector>

namespace {

template <class Function>
Function of_proj(const char* name) {
  const auto out = reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
  if (!out) std::abort();
  return out;
}

std::vector<std::string> authorities(void* context) {
  char** const names = of_proj<char** (*)(void*)>("proj_get_authorities_from_database")(context);
  std::vector<std::string> out;
  for (char** name = names; name && *name; ++name) out.emplace_back(*name);
  of_proj<void (*)(char**)>("proj_string_list_destroy")(names);
  return out;
}

}  // namespace

extern "C" void* proj_create(void* context, const char* definition) {
  static const auto create = of_proj<void* (*)(void*, const char*)>("proj_create");
  constexpr size_t most_refused = 10000;
  static std::unordered_set<std::string> refused;
  const std::string text = definition;
  const bool urn = text.starts_with("urn:");
  if (urn && refused.contains(text)) return nullptr;
  void* const made = create(context, definition);
  if (urn && !made && refused.size() < most_refused) refused.insert(text);
  return made;
}

// The caller frees the list with proj_string_list_destroy(), which uses delete[].
extern "C" char** proj_get_authorities_from_database(void* context) {
  static const std::vector<std::string> names = authorities(context);
  char** const list = new char*[names.size() + 1]();
  for (size_t i = 0; i < names.size(); ++i) list[i] = std::strcpy(new char[names[i].size() + 1], names[i].c_str());
  return list;
}
