// The place where an output that the user has named really goes. A name may be a symbolic link, a device or a pipe, and
// a rename() over it would put a plain file in its place: as root even /dev/null would be gone.
#pragma once
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace wavetracer {

// Follows the symbolic links that the path names and returns what they lead to, which need not exist; the path itself
// where it is no link. Throws RuntimeError where the links lead in a circle.
std::filesystem::path behind_links(const std::filesystem::path& path);

struct OutputPlace {
  std::filesystem::path target;  // behind links
  bool stream = false;           // a pipe or a character device: bytes are written into what is there
};

// Returns the place of a file with this name. Throws RuntimeError where it cannot be written: a folder, a socket, a
// disk, links in a circle.
OutputPlace output_place(const std::filesystem::path& path);

// Removes the plain file of that name, behind links; links, devices and pipes stay. Nothing where it cannot be removed.
void remove_old_file(const std::filesystem::path& path) noexcept;

// The name under which a file or folder is written before it gets this one, which is behind links.
std::filesystem::path temporary_beside(const std::filesystem::path& target);

// The folder, or where it is not there the nearest one above it that is. error: set where the file system cannot tell;
// the path is empty where there is no folder that a relative name begins at.
std::filesystem::path nearest_existing(const std::filesystem::path& folder, std::error_code& error);

// Says why no file can be written in nearest_existing(folder); empty where one can be. It tries by writing one that has
// no name: permissions alone tell nothing of root, of file systems and of full disks.
std::string write_obstacle(const std::filesystem::path& folder);

// An empty file without a name, in a folder for temporary files (temporary_folders()): its descriptor, for reading and
// writing, which the caller closes. Throws RuntimeError. wanted_for: for messages.
std::vector<std::filesystem::path> temporary_folders();  // TMPDIR, if that is set, /tmp and /var/tmp
int unnamed_file(const std::filesystem::path& wanted_for);

}  // namespace wavetracer
