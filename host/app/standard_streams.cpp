// SPDX-License-Identifier: Apache-2.0
// std::cout does not keep the reason of a failed write, so it writes through our buffer, which does.
// This is for Linux only.
#include "app/standard_streams.hpp"
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <streambuf>

namespace wavetracer::app {
namespace {

// Keeps the reason of the first write that failed; std::cout writes through it.
class CheckedOutput : public std::streambuf {
 public:
  // 0 if no write has failed.
  int error() const { return error_; }

 protected:
  std::streamsize xsputn(const char* text, std::streamsize count) override {
    const auto wanted = static_cast<size_t>(count);
    if (std::fwrite(text, 1, wanted, stdout) != wanted) return note(), 0;
    return count;
  }
  int_type overflow(int_type c) override {
    if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
    const char one = traits_type::to_char_type(c);
    return xsputn(&one, 1) == 1 ? c : traits_type::eof();
  }
  int sync() override { return std::fflush(stdout) == 0 ? 0 : (note(), -1); }

 private:
  int error_ = 0;
  void note() {
    if (error_ == 0) error_ = errno != 0 ? errno : EIO;
  }
};

CheckedOutput& checked_output() {
  static auto* const output = new CheckedOutput;  // std::cout uses it until the process ends
  return *output;
}

}  // namespace

void keep_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(descriptor, F_GETFD) < 0 && errno == EBADF)
      ::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);  // open() takes the lowest free number
  std::cout.rdbuf(&checked_output());
}

std::string output_problem() {
  std::cout.flush();
  const int error = checked_output().error();
  if (error == 0) return "";
  const bool full = error == ENOSPC || error == EDQUOT || error == EFBIG;
  return fmt::format("standard output cannot be written: {}; what was printed is not complete: {}",
                     std::strerror(error), full ? "free some space there, or lead it elsewhere" : "lead it elsewhere");
}

std::ostream& word_about(const std::filesystem::path& written) {
  struct stat file {
  }, output{};
  const bool same = ::stat(written.c_str(), &file) == 0 && ::fstat(STDOUT_FILENO, &output) == 0 &&
                    file.st_dev == output.st_dev && file.st_ino == output.st_ino;
  return same ? std::cerr : std::cout;
}

}  // namespace wavetracer::app
