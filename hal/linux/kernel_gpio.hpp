// SPDX-License-Identifier: Apache-2.0
// The machine's own GPIO chips, through the kernel by libgpiod.
#pragma once

#include <memory>
#include <tl/expected.hpp>

#include "hal/linux/gpio.hpp"

namespace penduline {

/// Lines are held in the name "penduline". A line that somebody else holds is refused, saying who.
class KernelGpio final : public Gpio {
 public:
  tl::expected<std::unique_ptr<GpioOutput>, Error> open_output(const GpioLine& line,
                                                               GpioDrive drive,
                                                               bool active) override;
  tl::expected<std::unique_ptr<GpioInput>, Error> open_input(const GpioLine& line) override;
};

}  // namespace penduline
