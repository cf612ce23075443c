// SPDX-License-Identifier: Apache-2.0
// The secret that clients must send if users of other machines can connect.
// The file must be readable by its owner only, like keys of ssh.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace wavetracer::live {

// Returns the file's text without surrounding white space, 16 to 4096 bytes of printable ASCII. Throws ConfigError or
// InputError.
std::string read_token(const std::filesystem::path& file);

// Takes the same time wherever the two differ. The length of the secret is not protected.
bool same_token(std::string_view secret, std::string_view shown);

}  // namespace wavetracer::live
