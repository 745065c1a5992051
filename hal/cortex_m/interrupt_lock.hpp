// SPDX-License-Identifier: Apache-2.0
// Keeps all interrupts away for as long as it lives.
#pragma once

#include <cstdint>

namespace penduline::cortex_m {

class InterruptLock {
 public:
  InterruptLock() { asm volatile("mrs %0, primask\n cpsid i" : "=r"(before_)::"memory"); }
  ~InterruptLock() { asm volatile("msr primask, %0" ::"r"(before_) : "memory"); }
  InterruptLock(const InterruptLock&) = delete;
  InterruptLock& operator=(const InterruptLock&) = delete;

 private:
  std::uint32_t before_;
};

}  // namespace penduline::cortex_m
