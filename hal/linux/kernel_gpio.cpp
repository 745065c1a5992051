// SPDX-License-Identifier: Apache-2.0
// Requesting, driving and watching lines; libgpiod's exceptions end here.
#include "hal/linux/kernel_gpio.hpp"

#include <fmt/format.h>

#include <bitset>
#include <cerrno>
#include <cstddef>
#include <gpiod.hpp>
#include <string>
#include <system_error>
#include <utility>

#include "hal/linux/gpio_search.hpp"

namespace penduline {
namespace {

/// How many edges the kernel keeps for who is slow (DECLARE_KFIFO in its gpiolib-cdev.c).
constexpr std::size_t kKernelQueue = 16;

/// Does something to a line; its failure names the line.
template <class Work>
tl::expected<void, Error> attempt(const std::string& name, const Work& work) {
  try {
    work();
    return {};
  } catch (const std::system_error& error) {
    return failure(fmt::format("GPIO line '{}': {}", name, error.code().message()));
  }
}

std::string busy_text(const std::string& name, const gpiod::line& line) {
  const std::string consumer = line.consumer();
  return fmt::format("GPIO line '{}': held by {}, expected a free line", name,
                     consumer.empty() ? "somebody else" : fmt::format("'{}'", consumer));
}

/// Finds a line and requests it.
tl::expected<gpiod::line, Error> request(const GpioLine& wanted, int type, std::bitset<32> flags,
                                         bool active) {
  const auto place = only_place(wanted.name, find_gpio_line(wanted.name));
  if (!place) {
    return tl::unexpected(place.error());
  }
  if (wanted.active_low) {
    flags |= gpiod::line_request::FLAG_ACTIVE_LOW;
  }
  gpiod::line line;
  std::string busy;
  const auto requested = attempt(wanted.name, [&] {
    line = gpiod::chip(place->chip, gpiod::chip::OPEN_BY_NAME).get_line(place->offset);
    try {
      line.request({"penduline", type, flags}, active ? 1 : 0);
    } catch (const std::system_error& error) {
      if (error.code().value() != EBUSY) {
        throw;
      }
      line.update();
      busy = busy_text(wanted.name, line);
    }
  });
  if (!requested) {
    return tl::unexpected(requested.error());
  }
  if (!busy.empty()) {
    return failure(busy);
  }
  return line;
}

class KernelOutput final : public GpioOutput {
 public:
  KernelOutput(std::string name, gpiod::line line)
      : name_(std::move(name)), line_(std::move(line)) {}
  KernelOutput(const KernelOutput&) = delete;
  KernelOutput& operator=(const KernelOutput&) = delete;
  ~KernelOutput() override {
    // Of a chip that has gone there is nothing to make safe.
    static_cast<void>(attempt(name_, [&] {
      line_.set_value(0);
      line_.release();
    }));
  }

  tl::expected<void, Error> set(bool active) override {
    return attempt(name_, [&] { line_.set_value(active ? 1 : 0); });
  }

 private:
  std::string name_;
  gpiod::line line_;
};

class KernelInput final : public GpioInput {
 public:
  KernelInput(std::string name, gpiod::line line)
      : name_(std::move(name)), line_(std::move(line)) {}

  tl::expected<GpioEdges, Error> wait(std::chrono::milliseconds patience) override {
    using std::chrono::microseconds;
    GpioEdges edges;
    const auto waited = attempt(name_, [&] {
      if (!line_.event_wait(patience)) {
        return;
      }
      for (const gpiod::line_event& event : line_.event_read_multiple()) {
        edges.host_us.push_back(std::chrono::floor<microseconds>(event.timestamp).count());
      }
    });
    if (!waited) {
      return tl::unexpected(waited.error());
    }
    // The kernel drops what comes while its queue is full, and does not count it.
    edges.queue_was_full = edges.host_us.size() >= kKernelQueue;
    return edges;
  }

 private:
  std::string name_;
  gpiod::line line_;
};

}  // namespace

tl::expected<std::unique_ptr<GpioOutput>, Error> KernelGpio::open_output(const GpioLine& line,
                                                                         GpioDrive drive,
                                                                         bool active) {
  const std::bitset<32> flags =
      drive == GpioDrive::kOpenDrain ? gpiod::line_request::FLAG_OPEN_DRAIN : std::bitset<32>();
  auto held = request(line, gpiod::line_request::DIRECTION_OUTPUT, flags, active);
  if (!held) {
    return tl::unexpected(held.error());
  }
  return std::make_unique<KernelOutput>(line.name, std::move(*held));
}

tl::expected<std::unique_ptr<GpioInput>, Error> KernelGpio::open_input(const GpioLine& line) {
  auto held = request(line, gpiod::line_request::EVENT_RISING_EDGE, {}, false);
  if (!held) {
    return tl::unexpected(held.error());
  }
  return std::make_unique<KernelInput>(line.name, std::move(*held));
}

}  // namespace penduline
