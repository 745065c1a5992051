// SPDX-License-Identifier: Apache-2.0
// Files of the kernel (sysfs, configfs), whose one line is read and written whole.
#pragma once

#include <fstream>
#include <stdexcept>
#include <string>

namespace penduline::test {

[[nodiscard]] inline std::string read_system_file(const std::string& path) {
  std::string line;
  if (std::ifstream file(path); !std::getline(file, line)) {
    throw std::runtime_error("cannot read " + path);
  }
  return line;
}

inline void write_system_file(const std::string& path, const std::string& line) {
  if (std::ofstream file(path); !(file << line << std::endl)) {
    throw std::runtime_error("cannot write " + path);
  }
}

}  // namespace penduline::test
