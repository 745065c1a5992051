// SPDX-License-Identifier: Apache-2.0
// From --output to the outputs.
#include "host/cli/output_options.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <string_view>
#include <utility>

#include "host/cli/log.hpp"
#include "host/output/estimate_file.hpp"
#include "host/output/line_writer.hpp"
#include "host/output/mqtt_writer.hpp"
#include "host/output/output_address.hpp"
#include "host/output/queued_output.hpp"
#include "host/output/rig_description.hpp"
#include "host/output/text_file.hpp"
#include "host/output/udp_output.hpp"

namespace penduline {
namespace {

using OpenedOutput = tl::expected<std::unique_ptr<Output>, Error>;

constexpr const char* kPasswordVariable = "PENDULINE_MQTT_PASSWORD";
constexpr std::string_view kStandardOutput = "-";

/// The addresses, checked when the options were.
std::vector<OutputAddress> parsed(const OutputOptions& options) {
  std::vector<OutputAddress> addresses;
  for (const std::string& text : options.addresses) {
    addresses.push_back(parse_output(text).value());
  }
  if (addresses.empty()) {
    addresses.emplace_back(TextAddress{std::string(kStandardOutput)});
  }
  return addresses;
}

/// The password beside the address: the file's first line, else the environment's.
tl::expected<std::string, Error> stored_password(const OutputOptions& options) {
  if (options.mqtt_password_file.empty()) {
    const char* const value = std::getenv(kPasswordVariable);
    return value == nullptr ? "" : value;
  }
  std::ifstream file(options.mqtt_password_file);
  std::string line;
  if (!std::getline(file, line)) {
    return failure(fmt::format("{}: found no line, expected the password of the MQTT broker",
                               options.mqtt_password_file));
  }
  return line;
}

/// Opens the kinds of output.
class Opening {
 public:
  Opening(const OutputOptions& options, bool live, const OutputSubject& subject)
      : options_(options), live_(live), subject_(subject) {}

  OpenedOutput operator()(const TextAddress& address) const {
    auto file = TextFile::create(address.path);
    if (!file) {
      return tl::unexpected(file.error());
    }
    if (!live_) {
      return std::make_unique<EstimateFile>(std::move(*file), options_.layout);
    }
    const bool only_use = options_.addresses.size() <= 1 && !subject_.has_other_use;
    return std::make_unique<QueuedOutput>(
        std::make_unique<LineWriter>(std::move(*file), options_.layout, only_use));
  }

  OpenedOutput operator()(const UdpAddress& address) const { return UdpOutput::open(address); }

  OpenedOutput operator()(MqttAddress address) const {
    if (address.password.empty()) {
      auto password = stored_password(options_);
      if (!password) {
        return tl::unexpected(password.error());
      }
      address.password = std::move(*password);
    }
    auto writer = MqttWriter::make(std::move(address),
                                   {.qos = options_.mqtt_qos,
                                    .description = describe_rig(subject_.rig, subject_.header,
                                                                estimator_name(subject_.estimator)),
                                    .warn = log_warning});
    if (!writer) {
      return tl::unexpected(writer.error());
    }
    return std::make_unique<QueuedOutput>(std::move(*writer));
  }

 private:
  const OutputOptions& options_;
  bool live_;
  const OutputSubject& subject_;
};

bool is_standard_output(const OutputAddress& address) {
  const auto* text = std::get_if<TextAddress>(&address);
  return text != nullptr && text->path == kStandardOutput;
}

}  // namespace

void add_output_options(CLI::App& command, OutputOptions& options) {
  const std::map<std::string, EstimateFormat> formats{{"csv", EstimateFormat::kCsv},
                                                      {"jsonl", EstimateFormat::kJsonLines}};
  const CLI::Validator address(
      [](const std::string& text) {
        const auto parsed = parse_output(text);
        return parsed ? std::string() : parsed.error().message;
      },
      "");
  command
      .add_option(
          "-o,--output", options.addresses,
          "Where the estimates go, more than once if need be: a file; - the standard output;\n"
          "udp:HOST:PORT, JSON for PlotJuggler; mqtt://[USER@]HOST[:PORT]/TOPIC, a broker\n"
          "(mqtts: by TLS)")
      ->allow_extra_args(false)
      ->check(address)
      ->type_name("WHERE")
      ->default_str(std::string(kStandardOutput));
  command
      .add_option("--format", options.layout.format,
                  "How files and the standard output are written")
      ->transform(CLI::CheckedTransformer(formats).description(""))
      ->type_name("csv|jsonl")
      ->default_str("csv");
  command.add_flag("--utc", options.layout.utc,
                   "Add the column utc_s, the host's estimate of absolute time, to files and the\n"
                   "standard output; of boards, and of recordings from them");
  command.add_option("--mqtt-qos", options.mqtt_qos, "Quality of service of estimates by MQTT")
      ->check(CLI::IsMember({0, 1, 2}).description(""))
      ->type_name("0|1|2")
      ->capture_default_str();
  command
      .add_option("--mqtt-password-file", options.mqtt_password_file,
                  fmt::format("The first line is the broker's password. Else the environment's\n{} "
                              "is; mqtt://USER:PASSWORD@... shows it to everybody on the machine",
                              kPasswordVariable))
      ->type_name("FILE");
}

std::vector<std::string> output_paths(const OutputOptions& options) {
  std::vector<std::string> paths;
  for (const OutputAddress& address : parsed(options)) {
    if (const auto* text = std::get_if<TextAddress>(&address)) {
      paths.push_back(text->path);
    }
  }
  return paths;
}

void refuse_network_outputs(const OutputOptions& options) {
  for (const OutputAddress& address : parsed(options)) {
    if (!std::holds_alternative<TextAddress>(address)) {
      throw CLI::ValidationError(
          "--output",
          "udp: and mqtt: are for estimates that come at their own pace, by 'penduline "
          "run' without --fast and with --estimator gn");
    }
  }
}

tl::expected<void, Error> look_up_hosts(const OutputOptions& options) {
  for (const OutputAddress& address : parsed(options)) {
    if (const auto* udp = std::get_if<UdpAddress>(&address)) {
      if (const auto found = UdpOutput::open(*udp); !found) {
        return tl::unexpected(found.error());
      }
    }
  }
  return {};
}

tl::expected<std::unique_ptr<Outputs>, Error> open_outputs(const OutputOptions& options, bool live,
                                                           const OutputSubject& subject) {
  auto outputs = std::make_unique<Outputs>(log_warning);
  if (subject.has_other_use) {
    outputs->may_all_fail();
  }
  const Opening open(options, live, subject);
  for (const OutputAddress& address : parsed(options)) {
    auto output = std::visit(open, address);
    if (!output) {
      return tl::unexpected(output.error());
    }
    const bool essential = !live || (is_standard_output(address) && !subject.has_other_use);
    outputs->add(std::move(*output), essential ? Need::kEssential : Need::kOptional);
  }
  return outputs;
}

}  // namespace penduline
