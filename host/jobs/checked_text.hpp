// JSON objects with a hash of their own text, so that damage is told from what was written: the last key is "check".
#pragma once
#include <string>
#include <string_view>

namespace wavetracer {

// object: the text of a JSON object that is not empty, which ends in its brace. The same with the key added.
std::string with_check(std::string object);
// Is the text, which with_check() has made, as it was written? Blanks and line ends behind it do not count.
bool check_fits(std::string_view text);

}  // namespace wavetracer
