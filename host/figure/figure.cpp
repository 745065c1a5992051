// SPDX-License-Identifier: Apache-2.0
// Gnuplot's run on a figure's script.
#include "host/figure/figure.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <string_view>

#include "host/figure/figure_layout.hpp"
#include "host/figure/figure_script.hpp"
#include "host/output/text_file.hpp"

namespace penduline {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

constexpr int kNotFound = -1;

struct Drawing {
  int status = kNotFound;  ///< gnuplot's exit status, or kNotFound
  std::string picture{};
};

/// All that comes out of a pipe until its other end is closed.
std::string all_of(int pipe) {
  std::string text;
  std::array<char, 65536> piece{};
  for (;;) {
    const ssize_t count = ::read(pipe, piece.data(), piece.size());
    if (count > 0) {
      text.append(piece.data(), static_cast<std::size_t>(count));
    } else if (count == 0 || errno != EINTR) {
      return text;
    }
  }
}

/// The picture comes through a pipe: gnuplot would not notice that a disk is full.
Drawing run_gnuplot(std::FILE* input, std::FILE* complaints) {
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) {
    return {};
  }
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, fileno(input), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, pipe[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&files, fileno(complaints), STDERR_FILENO);
  std::string name = "gnuplot";
  std::string without_user_settings = "-d";
  std::array<char*, 3> arguments{name.data(), without_user_settings.data(), nullptr};
  pid_t child = 0;
  const int failed = posix_spawnp(&child, name.c_str(), &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  ::close(pipe[1]);
  Drawing drawing;
  if (failed == 0) {
    drawing.picture = all_of(pipe[0]);
    if (waitpid(child, &drawing.status, 0) != child) {
      drawing.status = kNotFound;
    }
  }
  ::close(pipe[0]);
  return drawing;
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
  if (auto room = require_room(figure); !room) {
    return failure(fmt::format("{}: {}", path, room.error().message));
  }
  const std::string script = script_of(figure, *terminal);
  const File input(std::tmpfile());
  const File complaints(std::tmpfile());
  if (!input || !complaints ||
      std::fwrite(script.data(), 1, script.size(), input.get()) != script.size() ||
      std::fflush(input.get()) != 0) {
    return failure(fmt::format("{}: no room for a temporary file", path));
  }
  std::rewind(input.get());
  const Drawing drawing = run_gnuplot(input.get(), complaints.get());
  if (drawing.status == kNotFound) {
    return failure(
        fmt::format("{}: found no gnuplot to draw it: apt-get install gnuplot-nox", path));
  }
  if (drawing.status != 0) {
    return failure(
        fmt::format("{}: gnuplot could not draw it: {}", path, last_line(complaints.get())));
  }
  return put_file(path, drawing.picture);
}

}  // namespace penduline
