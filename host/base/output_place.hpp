// SPDX-License-Identifier: Apache-2.0
// Finds where an output that the user has named is really written. The name may be a symbolic link, a device or a pipe.
// A rename() would replace it with a plain file: run as root, that would destroy even /dev/null.
#pragma once
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace wavetracer {

// Follows symbolic links and returns the path that they lead to, which need not exist; a path that is no link is
// returned unchanged. Throws RuntimeError if the links form a circle.
std::filesystem::path behind_links(const std::filesystem::path& path);

struct OutputPlace {
  std::filesystem::path target;  // the path after all links were followed
  bool stream = false;  // it is a pipe or a character device: bytes are written into it, and it is not replaced
};

// Returns the place of a file with this name. Throws RuntimeError if it cannot be written: it is a folder, a socket or
// a disk, or its links form a circle.
OutputPlace output_place(const std::filesystem::path& path);

// Removes the plain file that the name leads to. Links, devices and pipes stay. It does nothing if the file cannot be
// removed.
void remove_old_file(const std::filesystem::path& path) noexcept;

// Returns the temporary name under which a file or folder is written before it is renamed to `target`, which must not
// be a link.
std::filesystem::path temporary_beside(const std::filesystem::path& target);

// Returns the folder, or its nearest ancestor that exists. error: set if the file system reports an error. The returned
// path is empty if even the folder that a relative name starts from does not exist.
std::filesystem::path nearest_existing(const std::filesystem::path& folder, std::error_code& error);

// Returns the reason why no file can be written in nearest_existing(folder), or an empty string if files can be
// written. It tries to write a nameless file: permissions alone say nothing about root, read-only file systems and full
// disks.
std::string write_obstacle(const std::filesystem::path& folder);

// Creates an empty file without a name in one of temporary_folders(), and returns its descriptor for reading and
// writing. The caller closes it. Throws RuntimeError. wanted_for: the file's purpose, for messages.
std::vector<std::filesystem::path> temporary_folders();  // TMPDIR if it is set, then /tmp and /var/tmp
int unnamed_file(const std::filesystem::path& wanted_for);

}  // namespace wavetracer
