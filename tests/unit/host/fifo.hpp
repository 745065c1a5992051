// SPDX-License-Identifier: Apache-2.0
// A named pipe of two pages whose reader the test is.
#pragma once

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>
#include <system_error>

#include "tests/unit/temporary_folder.hpp"

namespace penduline::test {

class Fifo {
 public:
  /// A page for the head of a file, which is written alone, and one for rows.
  static constexpr int kBytes = 8192;

  Fifo() : path_(folder_.path("fifo")) {
    if (::mkfifo(path_.c_str(), 0600) != 0 ||
        (reader_ = ::open(path_.c_str(), O_RDONLY | O_NONBLOCK)) < 0 ||
        ::fcntl(reader_, F_SETPIPE_SZ, kBytes) != kBytes) {
      throw std::system_error(errno, std::generic_category(), path_);
    }
  }
  Fifo(const Fifo&) = delete;
  Fifo& operator=(const Fifo&) = delete;
  ~Fifo() { close_reader(); }

  [[nodiscard]] const std::string& path() const { return path_; }

  /// What is in the pipe; "" where there is nothing.
  [[nodiscard]] std::string read() const {
    std::array<char, kBytes> bytes{};
    const ssize_t got = ::read(reader_, bytes.data(), bytes.size());
    return {bytes.data(), got < 0 ? 0 : static_cast<std::size_t>(got)};
  }

  void close_reader() {
    if (reader_ >= 0) {
      ::close(reader_);
      reader_ = -1;
    }
  }

 private:
  TemporaryFolder folder_;
  std::string path_;
  int reader_ = -1;
};

}  // namespace penduline::test
