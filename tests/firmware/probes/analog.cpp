// SPDX-License-Identifier: Apache-2.0
// Shows the ADC: round robin, flags, FIFO interrupt, pacing, and DMA restarted by its interrupt.

#include "rp2040.hpp"

constexpr Word kEnable = 1, kStartOne = 1u << 2, kStartMany = 1u << 3, kReady = 1u << 8;
constexpr Word kDmaChannel = kDma, kDmaEnables = kDma + 0x404, kDmaStatus = kDma + 0x40c,
               kDmaAbort = kDma + 0x444;
constexpr Word kBlocks = 12, kBlock = 32;

extern "C" {
volatile Word ready_while_off, start_one_after, round_robin[4], fifo_interrupts, fifo_level_after;
volatile Word blocks_done, abort_reads, paced_conversions, restarted_conversions, done;
std::uint16_t blocks[kBlocks][kBlock];

void on_adc() {
  fifo_interrupts = fifo_interrupts + 1;
  read(kAdcFifo);  // one interrupt per result: the level is gone
}

static void start_block(Word block) {
  write(kDmaChannel, kAdcFifo);
  write(kDmaChannel + 4, reinterpret_cast<Word>(blocks[block]));
  write(kDmaChannel + 8, kBlock);
  write(kDmaChannel + 0xc,
        36u << 15 | 1u << 5 | 1u << 2 | 1u);  // DREQ_ADC, 16 bits, write address counts
}

void on_dma0() {
  write(kDmaStatus, 1);
  blocks_done = blocks_done + 1;
  if (blocks_done < kBlocks)
    start_block(blocks_done);
  else
    write(kAdcControl, kEnable);
}
}

static void empty_fifo() {
  while (!(read(kAdcFifoControl) & 1u << 8))
    read(kAdcFifo);
}

static void wait_us(Word us) {
  for (Word start = now_us(); now_us() - start < us;) {
  }
}

static void probe_flags() {
  ready_while_off = read(kAdcControl) & kReady;
  write(kAdcControl, kEnable);
  write(kAdcControl, kEnable | kStartOne);
  while (!(read(kAdcControl) & kReady)) {
  }
  start_one_after = read(kAdcControl) & kStartOne;
}

static void probe_round_robin() {
  write(kAdcFifoControl, 1);
  write(kAdcControl, kEnable | 3u << 16 | kStartMany);
  for (volatile Word& result : round_robin) {
    while (read(kAdcFifoControl) & 1u << 8) {
    }
    result = read(kAdcFifo);
  }
  write(kAdcControl, kEnable);
  wait_us(5);
  empty_fifo();
}

static void probe_fifo_interrupt() {
  write(kAdcFifoControl, 1u << 24 | 1);
  write(kAdcEnables, 1);
  enable_interrupt(22);
  for (int i = 0; i < 5; ++i) {
    write(kAdcControl, kEnable | kStartOne);
    wait_us(5);
  }
  write(kAdcEnables, 0);
  fifo_level_after = read(kAdcFifoControl) >> 16 & 0xf;
}

static Word level() {
  return read(kAdcFifoControl) >> 16 & 0xf;
}

static void probe_pacing() {
  write(kAdcFifoControl, 1);
  write(kAdcDivider, 4799u << 8);  // 100 us
  write(kAdcControl, kEnable | kStartMany);
  wait_us(50);
  write(kAdcControl, kEnable | kStartMany);  // goes on as it was
  wait_us(10);
  paced_conversions = level();
  write(kAdcControl, kEnable);
  wait_us(20);
  write(kAdcControl, kEnable | kStartMany);  // starts over; the old pace is forgotten
  wait_us(50);
  restarted_conversions = level() - paced_conversions;
  write(kAdcControl, kEnable);
  empty_fifo();
}

static void probe_dma() {
  write(kAdcDivider, 0);
  write(kAdcFifoControl, 1u << 24 | 1u << 3 | 1);
  write(kDmaEnables, 1);
  enable_interrupt(11);
  start_block(0);
  write(kAdcControl, kEnable | 3u << 16 | kStartMany);
  while (blocks_done < kBlocks)
    sleep();
  write(kDmaAbort, 1);
  abort_reads = read(kDmaAbort);
}

int main() {
  start_board();
  choose_analog(26);
  choose_analog(27);
  probe_flags();
  probe_round_robin();
  probe_fifo_interrupt();
  probe_pacing();
  probe_dma();
  done = 1;
}
