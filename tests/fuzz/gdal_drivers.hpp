// SPDX-License-Identifier: Apache-2.0
// Keeps only the GDAL drivers of a target's corpus. GDAL asks all two hundred of them about an input, which takes most
// of the time, and none of that is code of this program.
#pragma once
#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <string_view>

namespace wavetracer::fuzz {

template <class Function>
Function* gdal_function(const char* name) {
  auto* const out = reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
  if (!out) std::abort();
  return out;
}

// Removes all other drivers. The module for maps must have been opened, and must have read a file, before.
inline void keep_gdal_drivers(std::initializer_list<std::string_view> kept) {
  const auto count = gdal_function<int()>("GDALGetDriverCount");
  const auto driver = gdal_function<void*(int)>("GDALGetDriver");
  const auto name = gdal_function<const char*(void*)>("GDALGetDriverShortName");
  const auto remove = gdal_function<void(void*)>("GDALDeregisterDriver");
  for (int i = count(); i-- > 0;)
    if (std::find(kept.begin(), kept.end(), std::string_view(name(driver(i)))) == kept.end()) remove(driver(i));
  if (count() != static_cast<int>(kept.size())) std::abort();  // one has another name in this GDAL
}

}  // namespace wavetracer::fuzz
