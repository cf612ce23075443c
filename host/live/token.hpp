// The secret that clients show where others than this machine's users can connect.
// Assumes a file that only its owner can read, as keys of ssh are.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace wavetracer::live {

// The file's text without white space at its ends, 16 to 4096 bytes of printable ASCII. Throws ConfigError or
// InputError.
std::string read_token(const std::filesystem::path& file);

// Takes the same time wherever the two differ. The length of the secret is no secret.
bool same_token(std::string_view secret, std::string_view shown);

}  // namespace wavetracer::live
