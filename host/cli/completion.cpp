// SPDX-License-Identifier: Apache-2.0
// Completing options, their values, sources and outputs.
#include "host/cli/completion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

namespace penduline {
namespace {

using Completions = std::vector<Completion>;

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

/// Whether the option is to be followed by a word.
bool takes_value(const CLI::Option& option) {
  return option.get_items_expected_max() > 0 && option.nonpositional();
}

/// The option that is typed so; none where there is no such.
const CLI::Option* find_option(const CLI::App& command, const std::string& name) {
  return name.size() > 1 && name.front() == '-' ? command.get_option_no_throw(name) : nullptr;
}

/// The names that an option lets choose from, which it is described by: "csv|jsonl".
Completions choices_of(const std::string& type_name) {
  Completions choices;
  const bool are_choices =
      type_name.find('|') != std::string::npos &&
      std::ranges::none_of(type_name, [](char c) { return c >= 'A' && c <= 'Z'; });
  for (std::size_t begin = 0; are_choices && begin <= type_name.size();) {
    const std::size_t end = std::min(type_name.find('|', begin), type_name.size());
    choices.push_back({.word = type_name.substr(begin, end - begin), .help = ""});
    begin = end + 1;
  }
  return choices;
}

Completions sources(const std::vector<SerialDevice>& devices) {
  Completions found = {
      {.word = "auto", .help = "the board that is plugged in"},
      {.word = "sim:", .help = "a simulated rig"},
      {.word = "file:", .help = "a recording", .files = true},
      {.word = "serial:", .help = "a board's port", .files = true},
      {.word = fmt::format("usb:{:04x}:{:04x}", kPendulineVendor, kPendulineProduct),
       .help = "a board without its driver"}};
  for (const SerialDevice& device : devices) {
    if (device.is_penduline()) {
      found.push_back({.word = "auto:" + device.identity.serial_number, .help = device.text()});
      found.push_back({.word = "usb:" + device.identity.text(), .help = device.text()});
    }
  }
  return found;
}

Completions outputs() {
  return {{.word = "", .help = "", .files = true},
          {.word = "-", .help = "the standard output"},
          {.word = "udp:", .help = "HOST:PORT, JSON for PlotJuggler"},
          {.word = "mqtt://", .help = "HOST/TOPIC, a broker"},
          {.word = "mqtts://", .help = "HOST/TOPIC, a broker by TLS"}};
}

/// The values of an option or a positional argument, by how it is described.
Completions values_of(const CLI::Option& option, const std::vector<SerialDevice>& devices) {
  const std::string kind = option.nonpositional() ? option.get_type_name() : option.get_name();
  if (kind == "SOURCE") {
    return sources(devices);
  }
  if (kind == "WHERE") {
    return outputs();
  }
  if (kind == "FILE" || kind == "DIR") {
    return {{.word = "", .help = "", .files = true}};
  }
  return choices_of(kind);
}

std::vector<const CLI::App*> commands(const CLI::App& program) {
  return program.get_subcommands([](const CLI::App*) { return true; });
}

Completions names_of(const std::vector<const CLI::App*>& commands) {
  Completions names;
  for (const CLI::App* command : commands) {
    names.push_back({.word = command->get_name(), .help = first_line(command->get_description())});
  }
  return names;
}

/// The options that may still come.
Completions options_of(const CLI::App& command, const std::vector<std::string>& typed) {
  Completions options;
  for (const CLI::Option* option : command.get_options()) {
    const bool given = std::ranges::any_of(
        typed, [&](const std::string& word) { return find_option(command, word) == option; });
    if (!option->nonpositional() || (given && option->get_expected_max() <= 1)) {
      continue;
    }
    options.push_back(
        {.word = "--" + option->get_lnames().at(0), .help = first_line(option->get_description())});
  }
  return options;
}

/// What may stand behind a command and the words `typed` after it; also the next option's name
/// where `current` begins like one.
Completions next_of(const CLI::App& command, const std::vector<std::string>& typed,
                    const std::string& current, const std::vector<SerialDevice>& devices) {
  const CLI::Option* const before = typed.empty() ? nullptr : find_option(command, typed.back());
  if (before != nullptr && takes_value(*before)) {
    return values_of(*before, devices);
  }
  if (const std::size_t equals = current.find('=');
      current.starts_with("--") && equals != std::string::npos) {
    const CLI::Option* const option = find_option(command, current.substr(0, equals));
    Completions values = option == nullptr ? Completions() : values_of(*option, devices);
    for (Completion& value : values) {
      value.word.insert(0, current, 0, equals + 1);
    }
    return values;
  }
  if (current.starts_with('-')) {
    return options_of(command, typed);
  }
  std::size_t arguments = 0;
  bool is_value = false;
  for (const std::string& word : typed) {
    const CLI::Option* const option = is_value ? nullptr : find_option(command, word);
    arguments += !is_value && option == nullptr && !word.starts_with('-') ? 1U : 0U;
    is_value = option != nullptr && takes_value(*option);
  }
  const auto positionals =
      command.get_options([](const CLI::Option* option) { return !option->nonpositional(); });
  if (!positionals.empty() && positionals.back()->get_items_expected_max() > 1) {
    arguments = std::min(arguments, positionals.size() - 1);  // the last may come many times
  }
  return arguments < positionals.size() ? values_of(*positionals[arguments], devices)
                                        : options_of(command, typed);
}

}  // namespace

Completions complete(const CLI::App& program, const std::vector<std::string>& words,
                     const std::vector<SerialDevice>& devices) {
  if (words.empty()) {
    return {};
  }
  Completions all;
  const std::string& current = words.back();
  // As far as the words are commands, each is one of the command before.
  const CLI::App* command = &program;
  std::size_t depth = 0;
  for (; depth + 1 < words.size(); ++depth) {
    const auto inner = commands(*command);
    const auto named = std::ranges::find(inner, words[depth], &CLI::App::get_name);
    if (named == inner.end()) {
      break;
    }
    command = *named;
  }
  if (commands(*command).empty()) {
    const auto first = words.begin() + static_cast<std::ptrdiff_t>(depth);
    all = next_of(*command, {first, words.end() - 1}, current, devices);
  } else if (depth + 1 == words.size()) {
    all = current.starts_with('-') ? options_of(*command, {}) : names_of(commands(*command));
  }
  Completions fitting;
  std::ranges::copy_if(all, std::back_inserter(fitting), [&](const Completion& completion) {
    return completion.word.starts_with(current) ||
           (completion.files && current.starts_with(completion.word));
  });
  return fitting;
}

std::string text_of(const Completions& completions) {
  std::string text;
  for (const Completion& completion : completions) {
    text += completion.files ? fmt::format("\t{}\n", completion.word)
                             : fmt::format("{}\t{}\n", completion.word, completion.help);
  }
  return text;
}

}  // namespace penduline
