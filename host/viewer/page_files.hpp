// The sources of the page, host/viewer/page/*, and three.min.js, as the build embedded them.
// They hold no "</script": each goes into a script element as it is.
#pragma once
#include <string>
#include <string_view>

namespace wavetracer {

// Throws RuntimeError for a name that is not among them.
std::string_view page_file(std::string_view name);

}  // namespace wavetracer
