// SPDX-License-Identifier: Apache-2.0
// A disk whose fdatasync is counted, and takes as long or fails as a test wants.
#pragma once

#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <thread>

namespace penduline::test {

struct SlowDisk {
  std::atomic<int> syncs{0};
  std::atomic<bool> hangs{false};
  std::atomic<bool> fails{false};

  static SlowDisk& the_one() {
    static SlowDisk disk;
    return disk;
  }
};

}  // namespace penduline::test

/// In place of the system's, for the whole test program; include this header in one file only.
extern "C" int fdatasync(int file) {
  auto& disk = penduline::test::SlowDisk::the_one();
  ++disk.syncs;
  while (disk.hangs) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  if (disk.fails) {
    errno = EIO;
    return -1;
  }
  return static_cast<int>(::syscall(SYS_fdatasync, file));
}
