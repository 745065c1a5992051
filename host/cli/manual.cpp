// SPDX-License-Identifier: Apache-2.0
// From the commands' definition to mdoc(7).
#include "host/cli/manual.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <sstream>
#include <string_view>
#include <vector>

namespace penduline {
namespace {

/// Text that mdoc leaves as it is, but that each sentence begins on a line of its own.
std::string plain(std::string_view text) {
  std::string escaped = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool between_sentences = i > 0 && i + 1 < text.size() && text[i - 1] == '.' &&
                                   text[i] == ' ' && text[i + 1] >= 'A' && text[i + 1] <= 'Z';
    switch (const char character = between_sentences ? '\n' : text[i]) {
      case '\\':
        escaped += "\\e";
        break;
      case '-':
        escaped += "\\-";  // to be copied to a shell
        break;
      default:
        escaped += character;
    }
  }
  return escaped;
}

/// The words of a macro's line, none of which is a macro of its own.
std::string in_quotes(std::string_view text) {
  return '"' + plain(text) + '"';
}

/// Lines of prose run together; those that are indented stay as they are.
std::string paragraphs(const std::string& text) {
  std::string page;
  bool literal = false;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const bool example = line.starts_with("  ");
    if (example != literal) {
      page += example ? ".Bd -literal -offset indent\n" : ".Ed\n.Pp\n";
      literal = example;
    }
    if (!line.empty()) {
      page += plain(example ? line.substr(2) : line) + '\n';
    }
  }
  return page + (literal ? ".Ed\n" : "");
}

/// "--name VALUE" with all its names.
std::string heading_of(const CLI::Option& option) {
  std::string heading;
  const auto add = [&](const std::string& dashes, const std::string& name) {
    heading += fmt::format("{} Fl {}", heading.empty() ? "" : " ,", in_quotes(dashes + name));
  };
  for (const std::string& name : option.get_snames()) {
    add("", name);
  }
  for (const std::string& name : option.get_lnames()) {
    add("-", name);
  }
  if (!option.nonpositional()) {
    return " Ar " + in_quotes(option.get_name());
  }
  if (option.get_items_expected_max() > 0) {
    heading += " Ar " + in_quotes(option.get_type_name());
  }
  return heading;
}

std::string list_of(const std::vector<const CLI::Option*>& options) {
  std::string list = ".Bl -tag -width Ds\n";
  for (const CLI::Option* option : options) {
    list += fmt::format(".It{}\n{}", heading_of(*option), paragraphs(option->get_description()));
    if (!option->get_default_str().empty()) {
      list += fmt::format("(Default: {})\n", plain(option->get_default_str()));
    }
    if (option->get_required() && option->nonpositional()) {
      list += "(Required.)\n";
    }
  }
  return list + ".El\n";
}

std::vector<const CLI::App*> commands_of(const CLI::App& command) {
  return command.get_subcommands([](const CLI::App*) { return true; });
}

/// "calibrate rest".
std::string full_name(const CLI::App& command, const std::string& before) {
  return before.empty() ? command.get_name() : before + ' ' + command.get_name();
}

/// The command's own name with what it cannot do without.
std::string synopsis_of(const CLI::App& command, const std::string& name) {
  std::string synopsis = fmt::format(".Nm Cm {}", name);
  for (const CLI::Option* option : command.get_options()) {
    synopsis += option->get_required() ? heading_of(*option) : "";
  }
  return synopsis + (commands_of(command).empty() ? " Op Ar options\n" : " Ar command\n");
}

std::string section_of(const CLI::App& command, const std::string& before) {
  const std::string name = full_name(command, before);
  std::string page =
      fmt::format(".Ss {}\n.Bd -ragged -compact\n{}.Ed\n.Pp\n{}", name, synopsis_of(command, name),
                  paragraphs(command.get_description() + '.'));
  for (const std::string& group : command.get_groups()) {
    const auto options = command.get_options([&](const CLI::Option* option) {
      return option->get_group() == group && !group.empty() && option != command.get_help_ptr();
    });
    if (!options.empty()) {
      page += group == "Options" ? "" : fmt::format(".Pp\n.Em {} :\n", in_quotes(group));
      page += list_of(options);
    }
  }
  page += command.get_footer().empty() ? "" : ".Pp\n" + paragraphs(command.get_footer());
  for (const CLI::App* inner : commands_of(command)) {
    page += section_of(*inner, name);
  }
  return page;
}

}  // namespace

std::string manual_of_commands(const CLI::App& program) {
  std::string page;
  for (const CLI::App* command : commands_of(program)) {
    page += section_of(*command, "");
  }
  return page;
}

}  // namespace penduline
