// SPDX-License-Identifier: Apache-2.0
// A figure as a script of gnuplot, and gnuplot's run.
#include "host/figure/figure.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

namespace penduline {
namespace {

constexpr int kPanelWidth = 620;
constexpr int kPanelHeight = 480;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// The terminal for a file's ending.
std::optional<std::string> terminal_for(const std::filesystem::path& path, std::size_t panels) {
  const auto width = kPanelWidth * static_cast<int>(panels);
  if (path.extension() == ".svg") {
    return fmt::format("svg size {},{} font 'sans,12' background 'white'", width, kPanelHeight);
  }
  if (path.extension() == ".png") {
    return fmt::format("pngcairo size {},{} font 'sans,11'", width, kPanelHeight);
  }
  if (path.extension() == ".pdf") {
    constexpr double kPerInch = 100;
    return fmt::format("pdfcairo size {:.2f},{:.2f} font 'sans,11'", width / kPerInch,
                       kPanelHeight / kPerInch);
  }
  return std::nullopt;
}

std::string gnuplot_string(std::string_view text) {
  std::string result = "'";
  for (const char c : text) {
    result += c == '\'' ? "''" : std::string(1, c == '\n' ? ' ' : c);
  }
  return result + "'";
}

void put_rows(std::string& script, const Curve& curve) {
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) {
      script += '\n';  // gnuplot lifts its pen
    } else if (curve.style == CurveStyle::kErrorBars) {
      fmt::format_to(std::back_inserter(script), "{} {} {}\n", curve.x[i], curve.y[i],
                     curve.sigma_y[i]);
    } else {
      fmt::format_to(std::back_inserter(script), "{} {}\n", curve.x[i], curve.y[i]);
    }
  }
}

std::string_view style_of(CurveStyle style) {
  switch (style) {
    case CurveStyle::kLine:
      return "lines linewidth 1.5";
    case CurveStyle::kPoints:
      return "points pointtype 7 pointsize 0.4";
    case CurveStyle::kErrorBars:
      break;
  }
  return "yerrorbars pointtype 7 pointsize 0.4";
}

void put_panel(std::string& script, const Panel& panel) {
  // Colours that the colour-blind tell apart (Okabe and Ito).
  constexpr std::array<std::string_view, 6> kColours = {"#0072b2", "#d55e00", "#009e73",
                                                        "#cc79a7", "#e69f00", "#56b4e9"};
  for (std::size_t i = 0; i < panel.curves.size(); ++i) {
    fmt::format_to(std::back_inserter(script), "$curve{} << END\n", i);
    put_rows(script, panel.curves[i]);
    script += "END\n";
  }
  fmt::format_to(std::back_inserter(script),
                 "set title {}\nset xlabel {}\nset ylabel {}\nset size {}\nplot ",
                 gnuplot_string(panel.title), gnuplot_string(panel.x_label),
                 gnuplot_string(panel.y_label), panel.equal_scales ? "ratio -1" : "noratio");
  for (std::size_t i = 0; i < panel.curves.size(); ++i) {
    const Curve& curve = panel.curves[i];
    fmt::format_to(std::back_inserter(script), "{}$curve{} with {} linecolor rgb '{}' {}",
                   i == 0 ? "" : ", ", i, style_of(curve.style), kColours[i % kColours.size()],
                   curve.name.empty() ? "notitle" : "title " + gnuplot_string(curve.name));
  }
  script += '\n';
}

std::string script_of(const Figure& figure, const std::string& terminal,
                      const std::string& output) {
  std::string script =
      fmt::format("set terminal {} noenhanced\nset output {}\n", terminal, gnuplot_string(output));
  script += "set grid linecolor rgb '#dddddd'\nset tics nomirror\n";
  fmt::format_to(std::back_inserter(script), "set multiplot layout 1,{}\n", figure.panels.size());
  for (const Panel& panel : figure.panels) {
    put_panel(script, panel);
  }
  return script + "unset multiplot\n";
}

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

tl::expected<void, Error> draw(const Figure& figure, const std::string& path) {
  const auto terminal = terminal_for(path, figure.panels.size());
  if (!terminal) {
    return failure(fmt::format("{}: expected a name that ends in .svg, .pdf or .png", path));
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
