// SPDX-License-Identifier: Apache-2.0
// Gnuplot's run on a figure's script.
#include "host/figure/figure.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

#include "host/figure/figure_script.hpp"

namespace penduline {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

constexpr int kNotFound = -1;

/// Its exit status, or kNotFound.
int run_gnuplot(std::FILE* input, std::FILE* complaints) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, fileno(input), STDIN_FILENO);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&files, fileno(complaints), STDERR_FILENO);
  std::string name = "gnuplot";
  std::array<char*, 2> arguments{name.data(), nullptr};
  pid_t child = 0;
  const int failed = posix_spawnp(&child, name.c_str(), &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  int status = 0;
  if (failed != 0 || waitpid(child, &status, 0) != child) {
    return kNotFound;
  }
  return status;
}

/// The last thing that gnuplot had to say.
std::string last_line(std::FILE* file) {
  std::rewind(file);
  std::string last;
  std::array<char, 512> line{};
  while (std::fgets(line.data(), line.size(), file) != nullptr) {
    const std::string_view text(line.data());
    if (text.find_first_not_of(" \n") != std::string_view::npos) {
      last = text.substr(0, text.find('\n'));
    }
  }
  return last;
}

}  // namespace

tl::expected<void, Error> require_figure_name(const std::string& path) {
  if (!terminal_for({}, path)) {
    return failure(fmt::format("{}: expected a name that ends in .svg, .pdf or .png", path));
  }
  return {};
}

tl::expected<void, Error> draw(const Figure& figure, const std::string& path) {
  const auto terminal = terminal_for(figure, path);
  if (!terminal) {
    return require_figure_name(path);
  }
  const std::string unfinished = path + ".part";
  const std::string script = script_of(figure, *terminal, unfinished);
  const File input(std::tmpfile());
  const File complaints(std::tmpfile());
  if (!input || !complaints ||
      std::fwrite(script.data(), 1, script.size(), input.get()) != script.size()) {
    return failure(fmt::format("{}: no room for a temporary file", path));
  }
  std::rewind(input.get());
  const int status = run_gnuplot(input.get(), complaints.get());
  std::error_code error;
  if (status == kNotFound) {
    return failure(
        fmt::format("{}: found no gnuplot to draw it: apt-get install gnuplot-nox", path));
  }
  if (status != 0) {
    std::filesystem::remove(unfinished, error);
    return failure(
        fmt::format("{}: gnuplot could not draw it: {}", path, last_line(complaints.get())));
  }
  std::filesystem::rename(unfinished, path, error);
  if (error) {
    return failure(fmt::format("{}: cannot write: {}", path, error.message()));
  }
  return {};
}

}  // namespace penduline
