// SPDX-License-Identifier: Apache-2.0
// Lines of GPIO chips as a session uses them: found by name, driven, or watched for edges.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "hal/error.hpp"

namespace penduline {

/// A line as a rig file names it.
struct GpioLine {
  std::string name;         ///< as the kernel knows it; `gpioinfo` lists the names
  bool active_low = false;  ///< it is active where its wire is low

  bool operator==(const GpioLine&) const = default;
};

/// How an output makes its wire high.
enum class GpioDrive {
  kPushPull,
  kOpenDrain,  ///< it lets go, and a pull-up does it: others may pull the wire low as well
};

/// A line that is driven. It is made inactive and given back when this goes; when the program is
/// killed the kernel gives it back as it stands.
class GpioOutput {
 public:
  GpioOutput() = default;
  GpioOutput(const GpioOutput&) = delete;
  GpioOutput& operator=(const GpioOutput&) = delete;
  virtual ~GpioOutput() = default;

  /// Fails where the chip has gone, naming the line.
  virtual tl::expected<void, Error> set(bool active) = 0;
};

/// Edges in their order.
struct GpioEdges {
  std::vector<std::int64_t> host_us{};  ///< the interrupts' moments, CLOCK_MONOTONIC
  bool queue_was_full = false;          ///< others may be lost behind the last one
};

/// A line whose edges into its active state are noted by the kernel.
class GpioInput {
 public:
  GpioInput() = default;
  GpioInput(const GpioInput&) = delete;
  GpioInput& operator=(const GpioInput&) = delete;
  virtual ~GpioInput() = default;

  /// Waits for edges, `patience` at most, and takes all that the kernel has; none came where there
  /// are none. Fails where the chip has gone, naming the line.
  virtual tl::expected<GpioEdges, Error> wait(std::chrono::milliseconds patience) = 0;
};

/// All GPIO chips of a machine. Each line is opened at most once at a time; the error names the
/// line, what was found and what was expected.
class Gpio {
 public:
  Gpio() = default;
  Gpio(const Gpio&) = delete;
  Gpio& operator=(const Gpio&) = delete;
  virtual ~Gpio() = default;

  virtual tl::expected<std::unique_ptr<GpioOutput>, Error> open_output(const GpioLine& line,
                                                                       GpioDrive drive,
                                                                       bool active) = 0;
  virtual tl::expected<std::unique_ptr<GpioInput>, Error> open_input(const GpioLine& line) = 0;
};

}  // namespace penduline
