// SPDX-License-Identifier: Apache-2.0
// The interrupt handlers that the vector table names; the board defines them (board.cpp).
#pragma once

#include "hal/rp2040/registers.hpp"

namespace penduline::rp2040 {

void on_timer_0();
void on_timer_1();
void on_timer_2();
void on_dma_0();
void on_usb();
void on_uart_0();

}  // namespace penduline::rp2040
